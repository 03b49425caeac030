use core::f32::consts::TAU;

use lights::math::Aabb;

use super::area_lights::area_scale;
use super::file_loc::Typed;
use super::light_check::fault_of_power;
use super::loop_subdivision::loop_subdivision;
use super::meshes::{bilinear_mesh, check, triangle_mesh};
use super::ply::read_ply;
use super::quadrics::quadric;
use super::state::{FLATTENED, Reader};
use crate::extent_fault::extent_fault;
use crate::glam::{Affine3A, Vec3};
use crate::scene_light::scaled;
use crate::{Alpha, Color, Diagnostic, Emission, EmissionSides, MaterialId};

impl Reader {
    pub(super) fn shape(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let Typed { at, kind, .. } = typed;
        let at = *at;
        if self.state.is_singular() {
            // What it says is not looked at, as in pbrt.
            typed.parameters.accept_all();
            self.warn(at, &format!("Shape \"{kind}\""), FLATTENED);
            return Ok(());
        }
        let quadric = quadric(typed)?;
        let is_quadric = quadric.is_some();
        let mut mesh = match kind.as_str() {
            "trianglemesh" => triangle_mesh(typed)?,
            "loopsubdiv" => loop_subdivision(typed)?,
            "curve" => self.curve(typed)?,
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
            other => {
                let Some(quadric) = quadric else {
                    let what = format!("Shape \"{other}\"");
                    let expected = "is not understood and was left out: expected bilinearmesh, \
                                    curve, cylinder, disk, loopsubdiv, plymesh, sphere or \
                                    trianglemesh";
                    self.warn(at, &what, expected);
                    typed.parameters.accept_all();
                    return Ok(());
                };
                let Some(mesh) = self.add_as_such(typed, quadric) else {
                    return Ok(());
                };
                mesh
            }
        };
        check(at, &mesh)?;
        if mesh.drop_broken_normals() > 0 {
            let what = format!("Shape \"{kind}\"");
            self.warn(
                at,
                &what,
                "has normals that are not finite, which were dropped",
            );
        }
        mesh.name.clone_from(kind);
        let mut mesh = mesh.transformed(&Affine3A::from_mat4(self.state.transform));
        mesh.drop_empty_triangles();
        // Given normals say where the front is, whatever the order of the vertices.
        mesh.align_with_normals();
        let turns_over = if is_quadric {
            self.turns_quadrics_over()
        } else {
            self.state.reversed
        };
        if turns_over {
            mesh.turn_over();
        }
        mesh.material = self.shape_material(typed, || mesh.area());
        self.expect_extent(typed, &mesh.bounds());
        self.add_mesh(at, mesh)
    }

    /// Refuses a shape of this box that no scene can hold. What an object holds may be small where
    /// it is placed.
    pub(super) fn expect_extent(&self, typed: &Typed<'_>, bounds: &Aabb) {
        if self.objects.open.is_some() {
            return;
        }
        if let Some(message) = extent_fault(bounds) {
            let at = typed.at;
            typed.parameters.keep(at.path, at.line, message);
        }
    }

    /// The material of a shape of this area: the current one, with the media, the emission and the
    /// alpha mask of the shape.
    pub(super) fn shape_material(
        &mut self,
        typed: &Typed<'_>,
        area: impl FnOnce() -> f32,
    ) -> MaterialId {
        let material = self.material();
        let material = self.with_media(material);
        let material = self.with_light(material, typed, area);
        self.with_alpha(material, typed)
    }

    /// The material with the emission of the current area light; the same material without one.
    fn with_light(
        &mut self,
        material: MaterialId,
        typed: &Typed<'_>,
        area: impl FnOnce() -> f32,
    ) -> MaterialId {
        let Some(light) = self.state.area_light else {
            return material;
        };
        let area = area();
        let radiance = scaled(light.radiance, Vec3::splat(area_scale(&light, area)));
        let exitance = self.scene.mean(&radiance).max_element() * TAU;
        if let Some(message) = fault_of_power(exitance * area) {
            let at = typed.at;
            typed.parameters.keep(at.path, at.line, message);
        }
        let emission = Emission {
            radiance,
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
        self.met_stand_in = false;
        let opacity = self.share(typed, "alpha", 1.0);
        if self.met_stand_in {
            // Half a surface is worse than all of it.
            let what = "an `alpha` whose texture was not read";
            self.warn(typed.at, what, "was taken as opaque");
            return material;
        }
        if opacity == Color::Constant(Vec3::ONE) {
            return material;
        }
        let cutoff = None;
        self.twin(material, |twin| {
            twin.alpha = Some(Alpha { opacity, cutoff })
        })
    }
}
