// SPDX-License-Identifier: MIT
#![doc = include_str!("../README.md")]
#![warn(missing_docs)]
#![deny(unsafe_op_in_unsafe_fn)]

mod bodies;
mod meshes;
mod questions;
pub mod sys;

pub use bodies::{Body, BodyFacts, EncodeOptions};
pub use meshes::{Mesh, MeshFormat, MeshOptions};
pub use questions::{
    Answer, Ask, By, Contact, Method, Model, Mover, NetworkOptions, Opinion, Precision, Question, Verdict, Why, Workspace,
};
#[doc(inline)]
pub use sys::{Pose, Range, SafePose};

use std::ffi::CStr;
use std::fmt;
use std::os::raw::c_int;

include!(concat!(env!("OUT_DIR"), "/error_kind.rs"));

/// The library's version, as in the first line of neuralsvcd.h.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What the library refuses, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Error {
    kind: ErrorKind,
    text: &'static str,
    line: usize,
}

impl Error {
    /// Which field, or what of a file, is at fault.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }
    /// Of a file, the line at fault, from 1; `None` if no line is.
    pub fn line(&self) -> Option<usize> {
        Some(self.line).filter(|&line| line > 0)
    }
    fn new(kind: ErrorKind) -> Error {
        check(kind as c_int + 1, 0).unwrap_err()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            0 => f.write_str(self.text),
            line => write!(f, "line {}: {}", line, self.text),
        }
    }
}

impl std::error::Error for Error {}

/// What a function of the library returned.
fn check(result: c_int, line: usize) -> Result<(), Error> {
    if result == 0 {
        return Ok(());
    }
    // SAFETY: it returns a constant for any number.
    let text = unsafe { CStr::from_ptr(sys::nsvcd_result_string(result)) };
    let text = text.to_str().unwrap_or("an error");
    Err(Error { kind: ERROR_KINDS[result as usize - 1], text, line })
}

/// Does this build compute correctly on this processor? If not, what it proves may be false. Call it once at the start if
/// the C compiler or its flags are unusual. It takes a microsecond.
pub fn self_test() -> Result<(), Error> {
    // SAFETY: it takes nothing.
    check(unsafe { sys::nsvcd_self_test() }, 0)
}

impl Pose {
    /// At the origin, not turned.
    pub const IDENTITY: Pose = Pose::at([0.0; 3]);

    /// A position in metres, and a unit quaternion x y z w.
    pub const fn new(position: [f32; 3], rotation: [f32; 4]) -> Pose {
        Pose { position, rotation }
    }
    /// At a position in metres, not turned.
    pub const fn at(position: [f32; 3]) -> Pose {
        Pose::new(position, [0.0, 0.0, 0.0, 1.0])
    }
}

impl Default for Pose {
    fn default() -> Pose {
        Pose::IDENTITY
    }
}
