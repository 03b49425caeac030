use light_bounds::{InfiniteBounds, LightExtent};
use light_math::glam::{Mat3, Quat, Vec3};
use light_samplers::InstancedBvhLightSampler;
use light_samplers::light_bvh::{InstancedLightBvh, LightBvhOptions, LightPrototype, Placement};
use light_sets::{SetKind, SetLight};

use crate::{Emitter, Rng, SamplerCase};

/// Radiance of the sky, in W·m⁻²·sr⁻¹.
const SKY: f32 = 0.01;

/// Receivers at random places.
const CONTEXTS: usize = 24;

/// Prototypes that are placed several times, and all their lights where they are placed.
#[derive(Clone, Debug)]
pub struct PlacedCase {
    /// All lights in the order of their ids, with a sky as the last.
    pub case: SamplerCase,
    /// Where the prototypes are.
    pub placements: Vec<Placement>,
    prototypes: Vec<LightPrototype>,
}

impl PlacedCase {
    /// Two prototypes, of 40 lights of several kinds and of five spots, in `count` places: turned,
    /// mirrored, and scaled by 0.75 to 30.
    ///
    /// # Panics
    /// Never: generated lights are valid.
    #[must_use]
    pub fn village(count: usize, seed: u64) -> Self {
        let mut rng = Rng::new(seed);
        let kinds = [(SetKind::Mixed, 40), (SetKind::Spots, 5)];
        let kinds = kinds.map(|(kind, n)| SamplerCase::generated(kind, n, seed).emitters);
        let prototypes = kinds.each_ref().map(|emitters| {
            let extents: Vec<LightExtent> = emitters.iter().map(Emitter::extent).collect();
            LightPrototype::new(&extents).expect("valid bounds")
        });
        // 20 places are within 60 m, more are as dense.
        let side = 60.0 * (count as f32 / 20.0).sqrt();
        let (mut emitters, mut placements) = (Vec::new(), Vec::new());
        for i in 0..count {
            let (turn, scale) = motion(i);
            let translation = (rng.vec3() - 0.5) * Vec3::new(side, side, 60.0);
            let kind = i % 3 % 2;
            let placement = Placement::new([0, 1][kind], turn, scale, translation);
            placements.push(placement.expect("rigid"));
            let out = |x: Vec3| translation + turn * (x * scale);
            emitters.extend(
                kinds[kind]
                    .iter()
                    .map(|emitter| placed(emitter, scale, out)),
            );
        }
        emitters.push(Emitter::Sky { radiance: SKY });
        Self {
            case: SamplerCase::new("village", emitters, CONTEXTS, seed),
            placements,
            prototypes: prototypes.into(),
        }
    }

    /// A sampler of the prototypes where `placements` place them, and of the sky.
    ///
    /// # Panics
    /// If a placement is not within reach of a tree.
    #[must_use]
    pub fn sampler(&self, placements: &[Placement]) -> InstancedBvhLightSampler {
        self.sampler_opening(placements, usize::MAX)
    }

    /// The same, with so many lights of opened placements at most.
    ///
    /// # Panics
    /// If a placement is not within reach of a tree.
    #[must_use]
    pub fn sampler_opening(
        &self,
        placements: &[Placement],
        most_opened: usize,
    ) -> InstancedBvhLightSampler {
        let prototypes = self.prototypes.clone();
        let options = LightBvhOptions::DYNAMIC;
        let tree = InstancedLightBvh::build_opening(prototypes, placements, &options, most_opened);
        let sky = [InfiniteBounds::uniform(SKY)];
        InstancedBvhLightSampler::new(tree.expect("within reach"), &sky).expect("a sampler")
    }

    /// The same prototypes in other places.
    ///
    /// # Panics
    /// Never: they are within reach.
    #[must_use]
    pub fn elsewhere(&self) -> Vec<Placement> {
        let elsewhere = |(i, placed): (usize, &Placement)| {
            let at = Vec3::new(i as f32 * 7.0 % 50.0, i as f32 * 11.0 % 50.0, 3.0);
            let (turn, _) = motion(i + 1);
            Placement::new(placed.prototype(), turn, 1.0, at).expect("rigid")
        };
        self.placements.iter().enumerate().map(elsewhere).collect()
    }
}

/// Turns and scales.
fn motion(i: usize) -> (Quat, f32) {
    let quarter = Quat::from_mat3(&Mat3::from_cols(Vec3::Y, Vec3::NEG_X, Vec3::Z));
    let oblique = Quat::from_axis_angle(Vec3::new(0.48, 0.6, 0.64).normalize(), i as f32);
    [
        (Quat::IDENTITY, 1.0),
        (quarter, 2.0),
        (oblique, 1.0),
        (oblique, -0.75),
        (oblique, 30.0),
    ][i % 5]
}

/// A light where it is placed.
fn placed(emitter: &Emitter, scale: f32, out: impl Fn(Vec3) -> Vec3) -> Emitter {
    let &Emitter::Set(light) = emitter else {
        return *emitter;
    };
    Emitter::Set(match light {
        SetLight::Triangle {
            vertices,
            radiance,
            two_sided,
        } => {
            let mut vertices = vertices.map(&out);
            if scale < 0.0 {
                // The mirror image of its front.
                vertices.swap(1, 2);
            }
            SetLight::Triangle {
                vertices,
                radiance,
                two_sided,
            }
        }
        SetLight::Point { p, intensity } => SetLight::Point {
            p: out(p),
            intensity: intensity * scale * scale,
        },
        SetLight::Spot {
            p,
            target,
            intensity,
            cone_deg,
            delta_deg,
        } => SetLight::Spot {
            p: out(p),
            target: out(target),
            intensity: intensity * scale * scale,
            cone_deg,
            delta_deg,
        },
    })
}
