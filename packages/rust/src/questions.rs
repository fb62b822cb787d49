// SPDX-License-Identifier: MIT
use crate::{check, sys, Body, Error, ErrorKind, Pose, Range, SafePose};
use std::fmt;
use std::os::raw::{c_int, c_void};
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, Ordering};

/// A body in a question: its motion and its size. Many may share one body.
#[derive(Clone, Copy, Debug)]
pub struct Mover<'a> {
    /// what moves
    pub body: &'a Body,
    /// up to 65,536; between two of them the rotation is a slerp, and the pivot goes straight. One pose: the body rests
    /// there. None: it rests at the origin
    pub poses: &'a [Pose],
    /// of the poses, from 0 to 1, each at least 1e-7 after the one before; `None`: uniform
    pub times: Option<&'a [f32]>,
    /// of the body about its origin, 1e-6 to 1e6; default 1
    pub scale: f32,
    /// the point of the body, before scaling, that goes straight: the centre of mass, a hinge; default its origin
    pub pivot: [f32; 3],
}

impl<'a> Mover<'a> {
    /// A body that moves from pose to pose.
    pub fn new(body: &'a Body, poses: &'a [Pose]) -> Mover<'a> {
        Mover { body, poses, times: None, scale: 1.0, pivot: [0.0; 3] }
    }
    /// A body that rests at the origin.
    pub fn resting(body: &'a Body) -> Mover<'a> {
        Mover::new(body, &[])
    }
    fn to_c(self) -> Result<sys::nsvcd_mover, Error> {
        if self.times.map_or(false, |times| times.len() != self.poses.len()) {
            return Err(Error::new(ErrorKind::Times));
        }
        Ok(sys::nsvcd_mover {
            body: self.body.as_ptr(),
            poses: if self.poses.is_empty() { null() } else { self.poses.as_ptr() },
            count: self.poses.len(),
            times: self.times.filter(|times| !times.is_empty()).map_or(null(), |times| times.as_ptr()),
            scale: self.scale,
            pivot: self.pivot,
        })
    }
}

/// What is asked about two moving bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ask {
    /// do they hit each other at all? The answer's time is that of some contact, which is usually not the first
    #[default]
    Hit,
    /// do they, and when first?
    First,
    /// do they, and how near do they come?
    Distance,
}

/// How a question is answered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// by proof where both bodies have triangles, else by the network
    #[default]
    Default,
    /// facts
    Proof,
    /// an opinion, in strictly bounded time; for `Hit`, and a `Distance` that is estimated
    Network,
}

/// The network's decoders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// the largest
    #[default]
    Default,
    /// about 4 thousand multiplications for each pair of patches
    Tiny,
    /// about 13 thousand
    Small,
    /// about 40 thousand
    Base,
}

/// The arithmetic of the network's decoders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 32 bits
    #[default]
    Float,
    /// 8 bits
    Int8,
}

/// Options of the network. Zero means the default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NetworkOptions {
    /// the number of pairs of patches that are decoded, up to 256; default 8
    pub pairs: usize,
    /// the decoder
    pub model: Model,
    /// its arithmetic
    pub precision: Precision,
    /// share of collisions to be found: 0.99, 0.999 or 0.9999; default balanced errors
    pub recall: f32,
    /// share of their radii by which patches are inflated; default as much as `recall` needs, or 1 for a distance
    pub inflate: f32,
}

/// A question about two bodies. Zero is the default of everything but the bodies:
///
/// ```
/// # use neuralsvcd::*;
/// let ball = Body::sphere(0.5)?;
/// let path = [Pose::at([-5.0, 0.0, 0.0]), Pose::at([5.0, 0.0, 0.0])];
/// let question = Question { clearance: 0.1, ..Question::new(Mover::new(&ball, &path), Mover::resting(&ball)) };
/// assert_eq!(question.sweep(&mut Workspace::new())?.verdict, Verdict::Hit);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Question<'a> {
    /// a body
    pub a: Mover<'a>,
    /// another; either may move, or both, over the same time
    pub b: Mover<'a>,
    /// what about them
    pub ask: Ask,
    /// metres: how exact the answer has to be; not set with `Hit`. `First`: nothing travels farther than this from
    /// `time.low` to `time.high`. `Distance`: the bracket is no wider. Default a thousandth of the smaller body's radius
    pub to: f32,
    /// the same for `First` as a share of the motion, up to 1
    pub to_time: f32,
    /// metres: coming within this distance is a hit
    pub clearance: f32,
    /// metres: a contact at the start that is no deeper does not count, so that a body may rest on another or leave it
    pub slop: f32,
    /// metres: what comes within the clearance and this, but not within the clearance, may be left undecided
    pub tolerance: f32,
    /// `First`: up to four contacts, which hold the body, are told, not one
    pub manifold: bool,
    /// by proof or by the network
    pub method: Method,
    /// units of work that a proof may take; default 10,000,000, for `Distance` 100,000
    pub work: usize,
    /// 16, 32, 48 or 64, the default: the most segments that an interval of the motion is cut into
    pub segments: usize,
    /// of the network, if it answers
    pub network: NetworkOptions,
    /// the question is about surfaces alone: a body inside the other is free of it
    pub surfaces: bool,
    /// once it is true, which another thread may make it, a proof ends as if there were no more units of work
    pub stop: Option<&'a AtomicBool>,
}

/// Memory for questions. Each thread needs its own; it may be used again and again.
#[derive(Clone, Debug)]
pub struct Workspace(Box<[u64]>);

impl Workspace {
    /// Enough for any question.
    pub fn new() -> Workspace {
        // SAFETY: NULL stands for any question.
        let size = unsafe { sys::nsvcd_sweep_workspace_size(null()) };
        Workspace(vec![0; size / 8 + 1].into_boxed_slice())
    }
}

impl Default for Workspace {
    fn default() -> Workspace {
        Workspace::new()
    }
}

unsafe extern "C" fn is_stopped(user: *mut c_void) -> c_int {
    // SAFETY: it is `stop` of a question, which outlives the call of nsvcd_sweep.
    let stop = unsafe { &*user.cast::<AtomicBool>() };
    stop.load(Ordering::Relaxed).into()
}

impl<'a> Question<'a> {
    /// Do they hit each other?
    pub fn new(a: Mover<'a>, b: Mover<'a>) -> Question<'a> {
        Question {
            a,
            b,
            ask: Ask::Hit,
            to: 0.0,
            to_time: 0.0,
            clearance: 0.0,
            slop: 0.0,
            tolerance: 0.0,
            manifold: false,
            method: Method::Default,
            work: 0,
            segments: 0,
            network: NetworkOptions::default(),
            surfaces: false,
            stop: None,
        }
    }

    /// Answers the question. It allocates nothing.
    pub fn sweep(&self, workspace: &mut Workspace) -> Result<Answer, Error> {
        let question = self.to_c()?;
        let mut answer = std::mem::MaybeUninit::<sys::nsvcd_answer>::uninit();
        let (memory, size) = (workspace.0.as_mut_ptr().cast(), workspace.0.len() * 8);
        // SAFETY: what the question points to outlives the call; the workspace has so many bytes. Without an error the
        // answer is written.
        unsafe {
            check(sys::nsvcd_sweep(&question, memory, size, answer.as_mut_ptr()), 0)?;
            Ok(Answer::of(&answer.assume_init()))
        }
    }

    fn to_c(self) -> Result<sys::nsvcd_question, Error> {
        Ok(sys::nsvcd_question {
            a: self.a.to_c()?,
            b: self.b.to_c()?,
            ask: self.ask as c_int,
            to: self.to,
            to_time: self.to_time,
            clearance: self.clearance,
            slop: self.slop,
            tolerance: self.tolerance,
            manifold: self.manifold.into(),
            method: self.method as c_int,
            work: self.work,
            segments: self.segments,
            network: sys::nsvcd_network_options {
                pairs: self.network.pairs,
                model: self.network.model as c_int,
                precision: self.network.precision as c_int,
                recall: self.network.recall,
                inflate: self.network.inflate,
            },
            surfaces: self.surfaces.into(),
            stop: self.stop.map(|_| is_stopped as unsafe extern "C" fn(*mut c_void) -> c_int),
            user: self.stop.map_or(null_mut(), |stop| stop as *const AtomicBool as *mut c_void),
        })
    }
}

/// What is proven, or what the network thinks: see [`Answer::by`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Verdict {
    /// neither is known; [`Answer::why`] has the reason
    Undecided,
    /// the surfaces never come within the clearance, and no part of one body is inside the other
    Free,
    /// the surfaces come within the clearance, or a part of one body is inside the other at the start
    Hit,
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(["undecided", "free", "hit"][*self as usize])
    }
}

/// Which method reached the verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum By {
    /// a fact
    Proof,
    /// an opinion
    Network,
}

/// Why part of a question is not answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Why {
    /// surfaces come too near each other without meeting
    TooNear,
    /// [`Question::work`] was not enough, or it was stopped
    Work,
    /// something seems to be inside a mesh that is nearly closed; if nothing is, encode it as `open`
    Open,
}

/// Two triangles, and where they meet or are nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// metres, world
    pub point: [f32; 3],
    /// unit, world, from b to a; 0 if there is no direction
    pub normal: [f32; 3],
    /// metres between the triangles; 0: they meet
    pub gap: f32,
    /// in [0, 1]
    pub time: f32,
    /// as numbered in the mesh of a; `None`: none is named
    pub triangle_a: Option<u32>,
    /// as numbered in the mesh of b
    pub triangle_b: Option<u32>,
    /// the patch that holds `triangle_a`
    pub patch_a: u32,
    /// the patch that holds `triangle_b`
    pub patch_b: u32,
    /// in a manifold: of what touches, the same as long as that does
    pub id: u32,
}

/// What the network estimates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opinion {
    /// of a collision; positive means yes
    pub logit: f32,
    /// metres between the pair that `logit` is of; negative: the depth; infinity: no decoder was needed
    pub distance: f32,
    /// in [0, 1], at which the most suspicious pair comes closest
    pub time: f32,
    /// of that pair
    pub patch_a: u32,
    /// of that pair
    pub patch_b: u32,
    /// pairs of patches whose spheres meet and that no plane separates
    pub candidates: usize,
    /// there were more than [`NetworkOptions::pairs`] let through
    pub limited: bool,
}

/// What is known. Each field means the same whatever was asked. Unknown numbers are infinity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Answer {
    /// hit, free or undecided
    pub verdict: Verdict,
    /// a fact or an opinion
    pub by: By,
    /// the reason if the verdict is undecided, or a bracket wider than the question says; `None`: all is answered
    pub why: Option<Why>,
    /// a hit because one body, or a part of it, is inside the other at the start
    pub inside: bool,
    /// of the first contact, in [0, 1]: the bodies are free before `low`, and in contact at `high`. Only `First` brings
    /// these together; else `low` is 0, and `high` the time of a contact, perhaps not the first. Free: both are 1
    pub time: Range,
    /// metres: the least distance over the motion, or up to `time.high` of a hit
    pub distance: Range,
    /// where the bodies may go, at `time.low`
    pub safe: SafePose,
    /// metres, of a contact at the start; 0: there is none; infinity: no push-out ends it
    pub depth: f32,
    /// metres, world: by what a was pushed out of b for the slop
    pub push_out: [f32; 3],
    /// what `distance.high` is about, whatever the verdict
    pub nearest: Contact,
    /// of the network, if it was asked
    pub opinion: Option<Opinion>,
    /// units that the proof took
    pub work: usize,
    contacts: [Contact; 4],
    contact_count: usize,
}

impl Contact {
    fn of(c: &sys::nsvcd_contact) -> Contact {
        Contact {
            point: c.point,
            normal: c.normal,
            gap: c.gap,
            time: c.time,
            triangle_a: Some(c.triangle_a).filter(|&triangle| triangle != u32::MAX),
            triangle_b: Some(c.triangle_b).filter(|&triangle| triangle != u32::MAX),
            patch_a: c.patch_a,
            patch_b: c.patch_b,
            id: c.id,
        }
    }
}

impl Answer {
    /// Of a hit whose triangles are known, at `time.high`: one, or those of a manifold.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts[..self.contact_count]
    }

    fn of(c: &sys::nsvcd_answer) -> Answer {
        let opinion = Opinion {
            logit: c.opinion.logit,
            distance: c.opinion.distance,
            time: c.opinion.time,
            patch_a: c.opinion.patch_a,
            patch_b: c.opinion.patch_b,
            candidates: c.opinion.candidates,
            limited: c.opinion.limited != 0,
        };
        Answer {
            verdict: [Verdict::Undecided, Verdict::Free, Verdict::Hit][c.verdict as usize],
            by: [By::Proof, By::Network][c.by as usize],
            why: [None, Some(Why::TooNear), Some(Why::Work), Some(Why::Open)][c.why as usize],
            inside: c.inside != 0,
            time: c.time,
            distance: c.distance,
            safe: c.safe,
            depth: c.depth,
            push_out: c.push_out,
            nearest: Contact::of(&c.nearest),
            opinion: Some(opinion).filter(|_| c.opinion.asked != 0),
            work: c.work,
            contacts: c.contacts.map(|contact| Contact::of(&contact)),
            contact_count: c.contact_count,
        }
    }
}
