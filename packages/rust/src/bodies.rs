// SPDX-License-Identifier: MIT
use crate::{check, sys, Error, Mesh};
use std::fmt;
use std::ptr::{null, null_mut};

/// A mesh, or a shape, encoded once and asked about often. Threads may share it. It is one block of bytes without
/// pointers, to be stored or sent.
#[derive(Clone)]
pub struct Body {
    memory: Box<[u64]>,
    size: usize,
}

/// How a mesh is encoded. Zero means the default: `EncodeOptions { open: true, ..Default::default() }`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EncodeOptions {
    /// how many patches the surface is cut into, up to 65536; default by `patch_radius`, or else by the number of triangles
    pub patches: usize,
    /// metres: as many patches as give each about this radius; for a level, half the size of what moves in it
    pub patch_radius: f32,
    /// metres: the body is everything within this distance of the mesh
    pub convex_radius: f32,
    /// the mesh is a sheet, or a part cut out: nothing is inside it
    pub open: bool,
    /// the network can answer as well
    pub latents: bool,
    /// only the network can answer: fewer bytes, and no proof
    pub no_triangles: bool,
    /// triangles are stored with 16 bits a coordinate: fewer bytes, and a `quantization_error`
    pub coarse: bool,
}

/// What a body is, in its own frame; lengths are in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyFacts {
    /// bytes
    pub size: usize,
    /// number of patches
    pub patches: usize,
    /// centre of a sphere that contains the body
    pub centre: [f32; 3],
    /// radius of that sphere
    pub radius: f32,
    /// no point of the mesh is farther from the origin
    pub extent: f32,
    /// least corner of a box that contains the mesh; 0 if no triangles are stored
    pub low: [f32; 3],
    /// its greatest corner
    pub high: [f32; 3],
    /// of all patches
    pub mean_patch_radius: f32,
    /// of the mesh; 0 if none are stored
    pub triangles: usize,
    /// triangles, and parts of them, patch by patch
    pub stored_triangles: usize,
    /// verdicts are about triangles that are within this of the mesh's
    pub quantization_error: f32,
    /// by which the body exceeds its mesh
    pub convex_radius: f32,
    /// balls that cover the mesh; bodies of `svcd encode` may have some
    pub balls: usize,
    /// no point of a ball is farther from the body
    pub ball_error: f32,
    /// the network can answer
    pub latents: bool,
    /// of the mesh
    pub components: usize,
    /// those that are not closed, so that nothing is inside them for certain
    pub open_components: usize,
    /// edges of these that have an odd number of triangles
    pub open_edges: usize,
    /// it was encoded as `open`
    pub open: bool,
}

/// Bytes, with the library's alignment.
fn aligned(size: usize) -> Box<[u64]> {
    vec![0; size / 8 + 1].into_boxed_slice()
}

impl Body {
    /// Encodes a mesh for proofs.
    pub fn encode(mesh: &Mesh) -> Result<Body, Error> {
        Body::encode_with(mesh, &EncodeOptions::default())
    }

    /// Encodes a mesh with options.
    pub fn encode_with(mesh: &Mesh, options: &EncodeOptions) -> Result<Body, Error> {
        let options = sys::nsvcd_encode_options {
            patches: options.patches,
            patch_radius: options.patch_radius,
            convex_radius: options.convex_radius,
            open: options.open.into(),
            latents: options.latents.into(),
            no_triangles: options.no_triangles.into(),
            coarse: options.coarse.into(),
            balls: 0,
            progress: None,
            user: null_mut(),
        };
        let given = sys::nsvcd_mesh {
            positions: mesh.vertices.as_ptr() as *mut f32,
            indices: mesh.triangles.as_ptr() as *mut u32,
            vertex_count: mesh.vertices.len(),
            triangle_count: mesh.triangles.len(),
        };
        // SAFETY: the library reads the mesh, whose arrays are as long as their counts say.
        Body::made(|body| unsafe { sys::nsvcd_encode(&given, &options, null(), null_mut(), 0, body) })
    }

    /// A ball about the origin.
    pub fn sphere(radius: f32) -> Result<Body, Error> {
        // SAFETY: `body` is where the result goes.
        Body::made(|body| unsafe { sys::nsvcd_encode_sphere(radius, null(), body) })
    }

    /// All within a radius of the segment between two points.
    pub fn capsule(from: [f32; 3], to: [f32; 3], radius: f32) -> Result<Body, Error> {
        // SAFETY: as above; the points are read.
        Body::made(|body| unsafe { sys::nsvcd_encode_capsule(from.as_ptr(), to.as_ptr(), radius, null(), body) })
    }

    /// A box about the origin, by half its lengths. These include the radius of rounded edges, which may be 0.
    pub fn cuboid(half: [f32; 3], convex_radius: f32) -> Result<Body, Error> {
        // SAFETY: as above.
        Body::made(|body| unsafe { sys::nsvcd_encode_box(half.as_ptr(), convex_radius, null(), body) })
    }

    /// Balls about points: a point cloud, or the centres of a map of voxels.
    pub fn cloud(points: &[[f32; 3]], radius: f32) -> Result<Body, Error> {
        let at = points.as_ptr().cast();
        // SAFETY: as above; there are so many points.
        Body::made(|body| unsafe { sys::nsvcd_encode_cloud(at, points.len(), radius, null(), body) })
    }

    /// A copy of a body of the library's, which is freed.
    fn made(make: impl FnOnce(&mut *const sys::nsvcd_body) -> i32) -> Result<Body, Error> {
        let mut body = null();
        check(make(&mut body), 0)?;
        // SAFETY: it is a body, whose size its facts tell. It has no pointers, so that it may be moved.
        unsafe {
            let size = sys::nsvcd_body_describe(body).size;
            let mut memory = aligned(size);
            std::ptr::copy_nonoverlapping(body.cast::<u8>(), memory.as_mut_ptr().cast(), size);
            sys::nsvcd_body_free(body, null());
            Ok(Body { memory, size })
        }
    }

    /// A body from the bytes that `as_bytes` gave, or `svcd encode` wrote. They may come from anywhere: all are checked.
    pub fn from_bytes(bytes: &[u8]) -> Result<Body, Error> {
        let mut memory = aligned(bytes.len());
        let mut body = null();
        // SAFETY: the memory is aligned, and not smaller than the bytes.
        unsafe {
            std::ptr::copy_nonoverlapping(bytes.as_ptr(), memory.as_mut_ptr().cast(), bytes.len());
            check(sys::nsvcd_body_load(memory.as_ptr().cast(), bytes.len(), &mut body), 0)?;
        }
        Ok(Body { memory, size: bytes.len() })
    }

    /// The body as bytes, in the byte order of this machine.
    pub fn as_bytes(&self) -> &[u8] {
        // SAFETY: the memory is not smaller.
        unsafe { std::slice::from_raw_parts(self.memory.as_ptr().cast(), self.size) }
    }

    /// A copy, scaled about its origin by a factor for each axis. Negative ones mirror it. A question needs no copy of a
    /// body that is scaled as a whole: see [`Mover::scale`](crate::Mover::scale).
    pub fn scaled(&self, factors: [f32; 3]) -> Result<Body, Error> {
        let mut memory = aligned(self.size);
        let mut body = null();
        // SAFETY: the memory is as large as the body's.
        let result =
            unsafe { sys::nsvcd_body_scale(self.as_ptr(), factors.as_ptr(), memory.as_mut_ptr().cast(), self.size, &mut body) };
        check(result, 0)?;
        // SAFETY: it is a body now; it may have become smaller.
        let size = unsafe { sys::nsvcd_body_describe(body).size };
        Ok(Body { memory, size })
    }

    /// What the body is.
    pub fn facts(&self) -> BodyFacts {
        // SAFETY: it is a body.
        let facts = unsafe { sys::nsvcd_body_describe(self.as_ptr()) };
        BodyFacts {
            size: facts.size,
            patches: facts.patches,
            centre: facts.centre,
            radius: facts.radius,
            extent: facts.extent,
            low: facts.low,
            high: facts.high,
            mean_patch_radius: facts.mean_patch_radius,
            triangles: facts.triangles,
            stored_triangles: facts.stored_triangles,
            quantization_error: facts.quantization_error,
            convex_radius: facts.convex_radius,
            balls: facts.balls,
            ball_error: facts.ball_error,
            latents: facts.latents != 0,
            components: facts.components,
            open_components: facts.open_components,
            open_edges: facts.open_edges,
            open: facts.open != 0,
        }
    }

    pub(crate) fn as_ptr(&self) -> *const sys::nsvcd_body {
        self.memory.as_ptr().cast()
    }
}

impl fmt::Debug for Body {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Body").field("facts", &self.facts()).finish()
    }
}
