use core::str::FromStr;

use light_scene::glam::{Vec2, Vec3};
use light_scene::{Material, Surface};

/// What diffuse surfaces become.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gloss {
    kind: Kind,
    /// The width of the microfacet distribution.
    alpha: f32,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The same under a clear coat.
    Coat,
    /// Silver.
    Metal,
}

impl Gloss {
    /// Changes a material that is diffuse.
    pub(super) fn apply(self, material: &mut Material) {
        let Surface::Diffuse { reflectance } = material.surface else {
            return;
        };
        let alpha = Vec2::splat(self.alpha);
        material.surface = match self.kind {
            Kind::Coat => Surface::CoatedDiffuse {
                reflectance,
                eta: 1.5,
                alpha,
            },
            Kind::Metal => Surface::Conductor {
                eta: Vec3::new(0.15, 0.13, 0.13),
                k: Vec3::new(4.1, 3.2, 2.4),
                alpha,
            },
        };
    }
}

impl FromStr for Gloss {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (kind, alpha) = match text.split_once(':') {
            Some(("coat", alpha)) => (Kind::Coat, alpha),
            Some(("metal", alpha)) => (Kind::Metal, alpha),
            _ => return Err("expected coat:ALPHA or metal:ALPHA"),
        };
        let alpha = alpha
            .parse()
            .ok()
            .filter(|alpha| (0.0..=1.0).contains(alpha));
        let alpha = alpha.ok_or("expected a width of 0 to 1 behind the colon")?;
        Ok(Self { kind, alpha })
    }
}
