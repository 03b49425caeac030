use crate::glam::{Vec2, Vec3};
use crate::{Alpha, Color, ColorImage, Emission, EmissionSides, Material, Scene, Surface};

/// One material as the library writes it.
#[derive(Debug)]
pub(super) struct Description {
    pub(super) name: String,
    diffuse: Option<Vec3>,
    diffuse_map: Option<ColorImage>,
    specular: Vec3,
    emitted: Vec3,
    emitted_map: Option<ColorImage>,
    /// `d`: the opacity.
    dissolve: Option<f32>,
    /// `Tr`: the transparency.
    transparency: Option<f32>,
    dissolve_map: Option<ColorImage>,
    index_of_refraction: f32,
    roughness: Option<f32>,
    metallic: f32,
    illumination: u8,
}

/// The closest surface model of a description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Finish {
    Matt,
    Lacquer,
    Metal,
    Mirror,
    Glass,
}

impl Description {
    /// The description that `tobj` has read, without its images.
    pub(super) fn of(material: &tobj::Material) -> Self {
        let color = |color: Option<[f32; 3]>| color.map(Vec3::from);
        let unknown = |keyword: &str| material.unknown_param.get(keyword)?.parse().ok();
        Self {
            name: material.name.clone(),
            diffuse: color(material.diffuse),
            diffuse_map: None,
            specular: color(material.specular).unwrap_or_default(),
            emitted: color(material.emissive).unwrap_or_default(),
            emitted_map: None,
            dissolve: material.dissolve,
            transparency: unknown("Tr"),
            dissolve_map: None,
            index_of_refraction: material.optical_density.unwrap_or(1.5),
            roughness: unknown("Pr"),
            metallic: unknown("Pm").unwrap_or(0.0),
            illumination: material.illumination_model.unwrap_or(2),
        }
    }

    /// Takes the image of a parameter.
    pub(super) fn set_map(&mut self, keyword: &str, image: Option<ColorImage>) {
        match keyword {
            "map_Kd" => self.diffuse_map = image,
            "map_Ke" => self.emitted_map = image,
            _ => self.dissolve_map = image,
        }
    }

    /// The ignored parts of the description, for a warning.
    pub(super) fn simplifications(&self) -> impl Iterator<Item = &'static str> {
        let finish = self.finish();
        let has_diffuse =
            self.diffuse_map.is_some() || self.diffuse.is_some_and(|c| c != Vec3::ZERO);
        let has_specular = self.specular != Vec3::ZERO;
        let disagree = |(d, tr): (f32, f32)| (d + tr - 1.0).abs() > 1e-3;
        [
            (
                finish == Finish::Matt && has_specular,
                "`Ks` of a matt surface was ignored: expected `Pr` of a lacquered one, or `illum \
                 3` or `5` of a mirror",
            ),
            (
                finish == Finish::Mirror && has_diffuse,
                "`Kd` of a mirror was ignored",
            ),
            (
                finish == Finish::Glass && has_diffuse,
                "`Kd` of glass was ignored",
            ),
            (
                finish == Finish::Matt && self.is_glassy(),
                "the glass of `illum 4`, `6`, `7` or `9` was taken as matt: expected `Ni` above 0",
            ),
            (
                finish == Finish::Metal && self.diffuse_map.is_some(),
                "`map_Kd` of a metal was taken as its mean",
            ),
            (
                self.metallic != 0.0 && self.metallic != 1.0,
                "`Pm` was taken as the nearer of 0 and 1",
            ),
            (
                self.dissolve.zip(self.transparency).is_some_and(disagree),
                "`Tr` was ignored: expected 1 minus `d`",
            ),
        ]
        .into_iter()
        .filter_map(|(is_so, message)| is_so.then_some(message))
    }

    pub(super) fn into_material(self, scene: &Scene) -> Material {
        let alpha = self.alpha();
        let is_hidden = alpha.as_ref().is_some_and(Alpha::hides_all);
        Material {
            emission: self.emission().filter(|_| !is_hidden),
            alpha,
            ..Material::new(self.name.clone(), self.surface(scene))
        }
    }

    fn emission(&self) -> Option<Emission> {
        // Emission of a material that does not emit is written as `Ke 0 0 0` by most exporters.
        let is_emissive = self.emitted != Vec3::ZERO;
        let radiance = match self.emitted_map {
            Some(image) => {
                let scale = if is_emissive { self.emitted } else { Vec3::ONE };
                Color::Image(ColorImage { scale, ..image })
            }
            None if is_emissive => Color::Constant(self.emitted),
            None => return None,
        };
        Some(Emission {
            radiance,
            sides: EmissionSides::Front,
        })
    }

    fn alpha(&self) -> Option<Alpha> {
        let stated = self.dissolve.or(self.transparency.map(|tr| 1.0 - tr));
        // The transparency of glass is its transmission, not an alpha mask.
        let is_glass = self.finish() == Finish::Glass;
        let scale = Vec3::splat(stated.filter(|_| !is_glass).unwrap_or(1.0));
        let opacity = match self.dissolve_map {
            Some(image) => Color::Image(ColorImage { scale, ..image }),
            None if scale == Vec3::ONE => return None,
            None => Color::Constant(scale),
        };
        let cutoff = None;
        Some(Alpha { opacity, cutoff })
    }

    /// Whether the illumination model is one of glass.
    fn is_glassy(&self) -> bool {
        matches!(self.illumination, 4 | 6 | 7 | 9)
    }

    fn finish(&self) -> Finish {
        let diffuse = self.diffuse.unwrap_or_default();
        match self.illumination {
            _ if self.metallic >= 0.5 => Finish::Metal,
            5 => Finish::Mirror,
            3 if self.specular.max_element() > diffuse.max_element() => Finish::Mirror,
            _ if self.is_glassy() && self.index_of_refraction > 0.0 => Finish::Glass,
            _ if self.roughness.is_some() && self.index_of_refraction > 1.0 => Finish::Lacquer,
            _ => Finish::Matt,
        }
    }

    fn surface(&self, scene: &Scene) -> Surface {
        // Perceived roughness to the width of the microfacet distribution, as exporters of `Pr`
        // mean it.
        let roughness = self.roughness.unwrap_or(0.5);
        let alpha = Vec2::splat(roughness * roughness);
        let reflectance = match self.diffuse_map {
            Some(image) => Color::Image(ColorImage {
                scale: self.diffuse.unwrap_or(Vec3::ONE),
                ..image
            }),
            None => Color::Constant(self.diffuse.unwrap_or(Vec3::splat(0.5))),
        };
        let eta = self.index_of_refraction;
        match self.finish() {
            Finish::Matt => Surface::Diffuse { reflectance },
            Finish::Lacquer => Surface::CoatedDiffuse {
                reflectance,
                eta,
                alpha,
            },
            Finish::Metal => Surface::conductor_of_reflectance(scene.mean(&reflectance), alpha),
            Finish::Mirror => Surface::Mirror {
                reflectance: self.specular,
            },
            Finish::Glass => Surface::Dielectric {
                eta,
                alpha: Vec2::ZERO,
            },
        }
    }
}
