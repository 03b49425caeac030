use super::file_loc::{FileLoc, Typed};
use crate::{Diagnostic, MaterialId, Mesh};

/// `Shape "trianglemesh"`.
pub(super) fn triangle_mesh(typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
    let mut mesh = vertices(typed)?;
    let count = mesh.positions.len();
    let indices = match typed.parameters.indices("indices") {
        Some(indices) => indices,
        None if count == 3 => vec![0, 1, 2],
        None => {
            return Err(typed
                .at
                .diagnostic("expected \"integer indices\" from 0 on"));
        }
    };
    if indices.len() % 3 != 0 {
        let message = format!("expected three indices a triangle, found {}", indices.len());
        return Err(typed.at.diagnostic(message));
    }
    mesh.indices = indices
        .chunks_exact(3)
        .map(|t| [t[0], t[1], t[2]])
        .collect();
    Ok(mesh)
}

/// A patch lists its corners row by row: (0,0), (1,0), (0,1), (1,1).
pub(super) fn bilinear_mesh(typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
    // It guides how pbrt samples a patch; what emits is the image of the area light.
    typed.parameters.accept("emissionfilename");
    let mut mesh = vertices(typed)?;
    let count = mesh.positions.len();
    let indices = match typed.parameters.indices("indices") {
        Some(indices) => indices,
        None if count == 4 => vec![0, 1, 2, 3],
        None => {
            return Err(typed
                .at
                .diagnostic("expected \"integer indices\" from 0 on"));
        }
    };
    if indices.len() % 4 != 0 {
        let message = format!("expected four indices a patch, found {}", indices.len());
        return Err(typed.at.diagnostic(message));
    }
    let triangles = |p: &[u32]| [[p[0], p[1], p[3]], [p[0], p[3], p[2]]];
    mesh.indices = indices.chunks_exact(4).flat_map(triangles).collect();
    Ok(mesh)
}

fn vertices(typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
    let parameters = &typed.parameters;
    let mut mesh = Mesh::new("", MaterialId(0));
    let positions = parameters.vec3s("P");
    mesh.positions = positions.ok_or_else(|| typed.at.diagnostic("expected \"point3 P\""))?;
    mesh.normals = parameters.vec3s("N");
    mesh.uvs = parameters.vec2s("uv").or_else(|| parameters.vec2s("st"));
    Ok(mesh)
}

/// The guarantees for the renderer.
pub(super) fn check(at: FileLoc<'_>, mesh: &Mesh) -> Result<(), Diagnostic> {
    let count = mesh.positions.len();
    let outside = mesh
        .indices
        .as_flattened()
        .iter()
        .find(|&&i| i as usize >= count);
    if let Some(index) = outside {
        let message = format!("vertex {index} of {count} does not exist");
        return Err(at.diagnostic(message));
    }
    let normals = mesh.normals.as_ref().map_or(count, Vec::len);
    let uvs = mesh.uvs.as_ref().map_or(count, Vec::len);
    if normals != count || uvs != count {
        let message =
            format!("expected as many normals and texture coordinates as vertices, {count}");
        return Err(at.diagnostic(message));
    }
    Ok(())
}
