// SPDX-License-Identifier: MIT
//! The functions and structs of neuralsvcd.h that this crate uses, as C has them. Their contracts are in the header. They
//! are for what the rest of the crate does not do, and may change with any version.
#![allow(non_camel_case_types, missing_docs)]
use std::os::raw::{c_char, c_int, c_void};

#[repr(C)]
pub struct nsvcd_body {
    _opaque: [u8; 0],
}

/// Declares a struct, and for its test the offsets of its fields and its size.
macro_rules! structs {
    ($($(#[$about:meta])* struct $name:ident { $($(#[$says:meta])* $field:ident: $type:ty,)* })*) => {
        $(
            $(#[$about])*
            #[repr(C)]
            #[derive(Clone, Copy)]
            pub struct $name { $($(#[$says])* pub $field: $type,)* }
        )*
        #[cfg(test)]
        fn layout() -> Vec<(&'static str, &'static str, usize)> {
            let mut all = Vec::new();
            $(
                let place = std::mem::MaybeUninit::<$name>::uninit();
                let at = place.as_ptr();
                $(
                    // SAFETY: no value is read.
                    let field = unsafe { std::ptr::addr_of!((*at).$field) };
                    all.push((stringify!($name), stringify!($field), field as usize - at as usize));
                )*
                all.push((stringify!($name), "size", std::mem::size_of::<$name>()));
            )*
            all
        }
    };
}

structs! {
    struct nsvcd_mesh {
        positions: *mut f32,
        indices: *mut u32,
        vertex_count: usize,
        triangle_count: usize,
    }
    struct nsvcd_mesh_options {
        format: c_int,
        origin: [f64; 3],
        scale: f64,
    }
    struct nsvcd_faces {
        positions: *const f32,
        corners: *const u32,
        sizes: *const u32,
        vertex_count: usize,
        corner_count: usize,
        face_count: usize,
    }
    struct nsvcd_encode_options {
        patches: usize,
        patch_radius: f32,
        convex_radius: f32,
        open: c_int,
        latents: c_int,
        no_triangles: c_int,
        coarse: c_int,
        balls: usize,
        progress: Option<unsafe extern "C" fn(f32, *mut c_void) -> c_int>,
        user: *mut c_void,
    }
    struct nsvcd_body_facts {
        size: usize,
        patches: usize,
        centre: [f32; 3],
        radius: f32,
        extent: f32,
        low: [f32; 3],
        high: [f32; 3],
        mean_patch_radius: f32,
        triangles: usize,
        stored_triangles: usize,
        quantization_error: f32,
        convex_radius: f32,
        balls: usize,
        ball_error: f32,
        latents: c_int,
        components: usize,
        open_components: usize,
        open_edges: usize,
        open: c_int,
    }
    /// The place of a body: nsvcd_pose.
    #[derive(Debug, PartialEq)]
    struct Pose {
        /// metres
        position: [f32; 3],
        /// unit quaternion, x y z w
        rotation: [f32; 4],
    }
    struct nsvcd_network_options {
        pairs: usize,
        model: c_int,
        precision: c_int,
        recall: f32,
        inflate: f32,
    }
    struct nsvcd_mover {
        body: *const nsvcd_body,
        poses: *const Pose,
        count: usize,
        times: *const f32,
        scale: f32,
        pivot: [f32; 3],
    }
    struct nsvcd_question {
        a: nsvcd_mover,
        b: nsvcd_mover,
        ask: c_int,
        to: f32,
        to_time: f32,
        clearance: f32,
        slop: f32,
        tolerance: f32,
        manifold: c_int,
        method: c_int,
        work: usize,
        segments: usize,
        network: nsvcd_network_options,
        surfaces: c_int,
        stop: Option<unsafe extern "C" fn(*mut c_void) -> c_int>,
        user: *mut c_void,
    }
    /// The number is no less than `low` and no more than `high`; infinity if it is not known: nsvcd_range.
    #[derive(Debug, PartialEq)]
    struct Range {
        #[allow(missing_docs)]
        low: f32,
        #[allow(missing_docs)]
        high: f32,
    }
    struct nsvcd_contact {
        point: [f32; 3],
        normal: [f32; 3],
        gap: f32,
        time: f32,
        triangle_a: u32,
        triangle_b: u32,
        patch_a: u32,
        patch_b: u32,
        id: u32,
    }
    /// Where the bodies may go, free of each other and pushed out of what they touch: nsvcd_safe_pose.
    #[derive(Debug, PartialEq)]
    struct SafePose {
        /// of the poses, in [0, 1]
        time: f32,
        /// of the first body, world
        a: Pose,
        /// of the second body, world
        b: Pose,
    }
    struct nsvcd_opinion {
        asked: c_int,
        logit: f32,
        distance: f32,
        time: f32,
        patch_a: u32,
        patch_b: u32,
        candidates: usize,
        limited: c_int,
    }
    struct nsvcd_answer {
        verdict: c_int,
        by: c_int,
        why: c_int,
        inside: c_int,
        time: Range,
        distance: Range,
        safe: SafePose,
        depth: f32,
        push_out: [f32; 3],
        contact_count: usize,
        contacts: [nsvcd_contact; 4],
        nearest: nsvcd_contact,
        opinion: nsvcd_opinion,
        work: usize,
    }
}

/// An allocator; this crate passes NULL: malloc and free.
pub enum nsvcd_allocator {}

#[rustfmt::skip]
extern "C" {
    pub fn nsvcd_result_string(result: c_int) -> *const c_char;
    pub fn nsvcd_self_test() -> c_int;
    pub fn nsvcd_mesh_parse(data: *const c_void, size: usize, options: *const nsvcd_mesh_options,
        allocator: *const nsvcd_allocator, mesh: *mut nsvcd_mesh, error_line: *mut usize) -> c_int;
    pub fn nsvcd_mesh_of_faces(faces: *const nsvcd_faces, allocator: *const nsvcd_allocator,
        mesh: *mut nsvcd_mesh) -> c_int;
    pub fn nsvcd_mesh_hull(points: *const f32, count: usize, allocator: *const nsvcd_allocator,
        hull: *mut nsvcd_mesh) -> c_int;
    pub fn nsvcd_mesh_of_heights(heights: *const f32, rows: usize, columns: usize, step: *const f32,
        allocator: *const nsvcd_allocator, mesh: *mut nsvcd_mesh) -> c_int;
    pub fn nsvcd_mesh_free(mesh: *mut nsvcd_mesh, allocator: *const nsvcd_allocator);
    pub fn nsvcd_encode(mesh: *const nsvcd_mesh, options: *const nsvcd_encode_options,
        allocator: *const nsvcd_allocator, memory: *mut c_void, capacity: usize, body: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_encode_sphere(radius: f32, allocator: *const nsvcd_allocator, body: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_encode_capsule(from: *const f32, to: *const f32, radius: f32, allocator: *const nsvcd_allocator,
        body: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_encode_box(half: *const f32, convex_radius: f32, allocator: *const nsvcd_allocator,
        body: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_encode_cloud(points: *const f32, count: usize, radius: f32, allocator: *const nsvcd_allocator,
        body: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_body_free(body: *const nsvcd_body, allocator: *const nsvcd_allocator);
    pub fn nsvcd_body_load(memory: *const c_void, size: usize, body: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_body_scale(body: *const nsvcd_body, scale: *const f32, memory: *mut c_void, capacity: usize,
        scaled: *mut *const nsvcd_body) -> c_int;
    pub fn nsvcd_body_describe(body: *const nsvcd_body) -> nsvcd_body_facts;
    pub fn nsvcd_sweep_workspace_size(question: *const nsvcd_question) -> usize;
    pub fn nsvcd_sweep(question: *const nsvcd_question, workspace: *mut c_void, workspace_size: usize,
        answer: *mut nsvcd_answer) -> c_int;
}

#[cfg(test)]
mod tests {
    #[test]
    fn structs_are_laid_out_as_in_c() {
        extern "C" {
            static nsvcd_rust_layout: [usize; 0];
            static nsvcd_rust_layout_count: usize;
        }
        let layout = super::layout();
        // SAFETY: src/neuralsvcd.c has them.
        assert_eq!(layout.len(), unsafe { nsvcd_rust_layout_count });
        for (i, (name, field, offset)) in layout.iter().enumerate() {
            // SAFETY: it has so many.
            let in_c = unsafe { std::ptr::addr_of!(nsvcd_rust_layout).cast::<usize>().add(i).read() };
            assert_eq!(*offset, in_c, "{} of {}", field, name);
        }
    }
}
