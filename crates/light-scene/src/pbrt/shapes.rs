use super::file_loc::{FileLoc, Typed};
use super::lights::area_scale;
use super::ply::read_ply;
use super::quadrics::{cylinder, disk, sphere};
use super::state::Reader;
use super::textures::scaled;
use crate::glam::{Affine3A, Vec3};
use crate::{Alpha, Color, Diagnostic, Emission, EmissionSides, MaterialId, Mesh};

impl Reader {
    pub(super) fn shape(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let Typed { at, kind, .. } = typed;
        let at = *at;
        if kind == "sphere" {
            if let Some(mut sphere) = self.whole_sphere(typed)? {
                sphere.material = self.shape_material(typed, || sphere.area());
                self.add_sphere(sphere);
                return Ok(());
            }
        }
        let mut mesh = match kind.as_str() {
            "trianglemesh" => triangle_mesh(typed)?,
            "loopsubdiv" => {
                ["levels", "scheme"]
                    .into_iter()
                    .for_each(|name| typed.parameters.accept(name));
                self.warn(at, "Shape \"loopsubdiv\"", "was taken as its control mesh");
                triangle_mesh(typed)?
            }
            "bilinearmesh" => {
                self.warn(
                    at,
                    "Shape \"bilinearmesh\"",
                    "was taken as two triangles a patch",
                );
                bilinear_mesh(typed)?
            }
            "plymesh" => {
                let name = typed.parameters.string("filename");
                let name = name.ok_or_else(|| at.diagnostic("expected \"string filename\""))?;
                read_ply(&self.resolve(name), self.files, &mut self.included)
                    .map_err(|error| at.diagnostic(error.to_string()))?
            }
            "sphere" => self.rounded(at, kind, sphere(typed)),
            "disk" => self.rounded(at, kind, disk(typed)),
            "cylinder" => self.rounded(at, kind, cylinder(typed)),
            other => {
                let what = format!("Shape \"{other}\"");
                self.warn(at, &what, "is not understood and was left out");
                return Ok(());
            }
        };
        check(at, &mesh)?;
        mesh.name.clone_from(kind);
        let mut mesh = mesh.transformed(&Affine3A::from_mat4(self.state.transform));
        mesh.drop_empty_triangles();
        // Given normals say where the front is, whatever the order of the vertices.
        mesh.align_with_normals();
        let is_quadric = matches!(kind.as_str(), "sphere" | "disk" | "cylinder");
        let turns_over = if is_quadric {
            self.turns_quadrics_over()
        } else {
            self.state.reversed
        };
        if turns_over {
            mesh.turn_over();
        }
        mesh.material = self.shape_material(typed, || mesh.area());
        self.add_mesh(at, mesh)
    }

    /// The material of a shape of this area: the current one, with the media, the emission and the
    /// alpha mask of the shape.
    fn shape_material(&mut self, typed: &Typed<'_>, area: impl FnOnce() -> f32) -> MaterialId {
        let material = self.material();
        let material = self.with_media(material);
        let material = self.with_light(material, area);
        self.with_alpha(material, typed)
    }

    fn rounded(&mut self, at: FileLoc<'_>, kind: &str, mesh: Mesh) -> Mesh {
        let what = format!("Shape \"{kind}\"");
        self.warn(at, &what, "was made of triangles");
        mesh
    }

    /// The material with the emission of the current area light; the same material without one.
    fn with_light(&mut self, material: MaterialId, area: impl FnOnce() -> f32) -> MaterialId {
        let Some(light) = self.state.area_light else {
            return material;
        };
        let mean = self.scene.mean(&light.radiance);
        let scale = area_scale(&light, mean, area());
        let emission = Emission {
            radiance: scaled(light.radiance, Vec3::splat(scale)),
            sides: if light.two_sided {
                EmissionSides::Both
            } else {
                EmissionSides::Front
            },
        };
        self.twin(material, |twin| twin.emission = Some(emission))
    }

    /// The material with the alpha mask of the parameter `alpha`; the same material without one.
    fn with_alpha(&mut self, material: MaterialId, typed: &Typed<'_>) -> MaterialId {
        if !typed.parameters.has("alpha") {
            return material;
        }
        let opacity = self.share(typed, "alpha", 1.0);
        if opacity == Color::Constant(Vec3::ONE) {
            return material;
        }
        let cutoff = None;
        self.twin(material, |twin| {
            twin.alpha = Some(Alpha { opacity, cutoff })
        })
    }
}

fn triangle_mesh(typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
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
fn bilinear_mesh(typed: &Typed<'_>) -> Result<Mesh, Diagnostic> {
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
fn check(at: FileLoc<'_>, mesh: &Mesh) -> Result<(), Diagnostic> {
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
