// SPDX-License-Identifier: MIT
use crate::{check, sys, Error, ErrorKind};
use std::os::raw::c_int;
use std::ptr::null;

/// Triangles. Both arrays are yours to fill, from whatever reads your format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// metres
    pub vertices: Vec<[f32; 3]>,
    /// vertex numbers from 0, counter-clockwise seen from outside
    pub triangles: Vec<[u32; 3]>,
}

/// The format of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeshFormat {
    /// STL if it begins with `solid` or is as long as its count of triangles says, else OBJ
    #[default]
    Any,
    /// Wavefront OBJ
    Obj,
    /// STL, binary or text
    Stl,
}

/// How the numbers of a file become metres. That is computed in double.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshOptions {
    /// of the file
    pub format: MeshFormat,
    /// the point, in the file's units, that becomes the mesh's origin: in a map, one near the objects
    pub origin: [f64; 3],
    /// metres in one of the file's units: 0.001 for millimetres; default 1
    pub scale: f64,
}

impl Default for MeshOptions {
    fn default() -> MeshOptions {
        MeshOptions { format: MeshFormat::Any, origin: [0.0; 3], scale: 1.0 }
    }
}

impl Mesh {
    /// Reads an OBJ file in metres. Faces of any number of corners are triangulated, concave ones too.
    pub fn from_obj(data: &[u8]) -> Result<Mesh, Error> {
        Mesh::parse(data, &MeshOptions { format: MeshFormat::Obj, ..Default::default() })
    }

    /// Reads an STL file, binary or text, in metres. Corners at the same position become one vertex.
    pub fn from_stl(data: &[u8]) -> Result<Mesh, Error> {
        Mesh::parse(data, &MeshOptions { format: MeshFormat::Stl, ..Default::default() })
    }

    /// Reads an OBJ or STL file, in other units or from another origin.
    pub fn parse(data: &[u8], options: &MeshOptions) -> Result<Mesh, Error> {
        let format = options.format as c_int;
        let options = sys::nsvcd_mesh_options { format, origin: options.origin, scale: options.scale };
        let mut line = 0;
        Mesh::made(|mesh| {
            // SAFETY: all pointers are of values that outlive the call.
            let result = unsafe { sys::nsvcd_mesh_parse(data.as_ptr().cast(), data.len(), &options, null(), mesh, &mut line) };
            check(result, line)
        })
    }

    /// Triangulates faces of any number of corners, concave ones too.
    pub fn from_faces<F: AsRef<[u32]>>(vertices: &[[f32; 3]], faces: &[F]) -> Result<Mesh, Error> {
        let sizes: Vec<u32> = faces.iter().map(|face| face.as_ref().len() as u32).collect();
        let corners: Vec<u32> = faces.iter().flat_map(|face| face.as_ref()).copied().collect();
        let given = sys::nsvcd_faces {
            positions: vertices.as_ptr().cast(),
            corners: corners.as_ptr(),
            sizes: sizes.as_ptr(),
            vertex_count: vertices.len(),
            corner_count: corners.len(),
            face_count: sizes.len(),
        };
        // SAFETY: the arrays are as long as their counts say, and outlive the call.
        Mesh::made(|mesh| check(unsafe { sys::nsvcd_mesh_of_faces(&given, null(), mesh) }, 0))
    }

    /// The convex hull of points: a closed mesh. `Empty` if all are in one plane.
    pub fn hull(points: &[[f32; 3]]) -> Result<Mesh, Error> {
        // SAFETY: there are so many points.
        Mesh::made(|mesh| check(unsafe { sys::nsvcd_mesh_hull(points.as_ptr().cast(), points.len(), null(), mesh) }, 0))
    }

    /// The mesh of a height field, z up: the sample of a row and a column is at (column * step\[0\], row * step\[1\]). NaN:
    /// there is no sample. Encode it as `open`. `Sizes` if the rows are not all `columns` long.
    pub fn from_heights(heights: &[f32], columns: usize, step: [f32; 2]) -> Result<Mesh, Error> {
        if columns == 0 || heights.len() % columns != 0 {
            return Err(Error::new(ErrorKind::Sizes));
        }
        let rows = heights.len() / columns;
        Mesh::made(|mesh| {
            // SAFETY: there are rows * columns heights.
            let result = unsafe { sys::nsvcd_mesh_of_heights(heights.as_ptr(), rows, columns, step.as_ptr(), null(), mesh) };
            check(result, 0)
        })
    }

    /// A mesh of the library's, copied and freed.
    fn made(make: impl FnOnce(&mut sys::nsvcd_mesh) -> Result<(), Error>) -> Result<Mesh, Error> {
        let empty = (std::ptr::null_mut(), std::ptr::null_mut());
        let mut mesh = sys::nsvcd_mesh { positions: empty.0, indices: empty.1, vertex_count: 0, triangle_count: 0 };
        make(&mut mesh)?;
        // SAFETY: the library has made it; its arrays are not empty, and [T; 3] is laid out as three T.
        unsafe {
            let vertices = std::slice::from_raw_parts(mesh.positions.cast(), mesh.vertex_count).to_vec();
            let triangles = std::slice::from_raw_parts(mesh.indices.cast(), mesh.triangle_count).to_vec();
            sys::nsvcd_mesh_free(&mut mesh, null());
            Ok(Mesh { vertices, triangles })
        }
    }
}
