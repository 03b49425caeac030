use light_bounds::LightSampleContext;
use light_math::glam::{DVec3, Vec3};

use crate::Rng;

/// Where light arrives, and how much directions count.
#[derive(Clone, Copy, Debug)]
pub(super) struct Receiver {
    pub(super) ctx: LightSampleContext,
    pub(super) p: DVec3,
    pub(super) facing: Facing,
}

/// The weight of a direction.
#[derive(Clone, Copy, Debug)]
pub(super) enum Facing {
    /// 1: the fluence.
    All,
    /// The cosine to this normal above the horizon: the irradiance.
    Front(DVec3),
    /// The absolute cosine: the irradiance of both sides.
    Both(DVec3),
}

impl Receiver {
    /// A receiver of any kind at `p`. Of three surfaces one is lit at a grazing angle from
    /// `toward`.
    pub(super) fn random(rng: &mut Rng, p: Vec3, toward: Vec3) -> Self {
        let to_light = (toward - p).try_normalize().unwrap_or(Vec3::X);
        let n = match rng.below(3) {
            0 => rng.direction(),
            1 => (to_light + rng.direction() * 0.9).normalize(),
            _ => {
                let across = to_light.cross(rng.direction()).normalize_or(Vec3::X);
                (across + to_light * rng.log_range(1e-3, 0.3)).normalize()
            }
        };
        let ns = match rng.below(2) {
            0 => n,
            _ => (n + 0.3 * rng.direction()).normalize(),
        };
        let [ctx, facing] = match rng.below(4) {
            0 => return Self::new(LightSampleContext::medium(p), Facing::All),
            1 => {
                return Self::new(
                    LightSampleContext::two_sided(p, n, ns),
                    Facing::Both(ns.as_dvec3()),
                );
            }
            _ => [n, ns],
        };
        Self::new(
            LightSampleContext::surface(p, ctx, facing),
            Facing::Front(facing.as_dvec3()),
        )
    }

    fn new(ctx: LightSampleContext, facing: Facing) -> Self {
        Self {
            ctx,
            p: ctx.p.as_dvec3(),
            facing,
        }
    }

    /// The weight of the unit direction `wi`.
    pub(super) fn weight(&self, wi: DVec3) -> f64 {
        match self.facing {
            Facing::All => 1.0,
            Facing::Front(n) => n.dot(wi).max(0.0),
            Facing::Both(n) => n.dot(wi).abs(),
        }
    }

    /// The same receiver elsewhere.
    pub(super) fn moved(&self, by: DVec3) -> Self {
        Self {
            p: self.p + by,
            ..*self
        }
    }

    /// The receiver with its normal turned by a small angle.
    pub(super) fn turned(&self, rng: &mut Rng, angle: f64) -> Self {
        let mut turned = |n: DVec3| (n + rng.direction().as_dvec3() * angle).normalize();
        let facing = match self.facing {
            Facing::All => Facing::All,
            Facing::Front(n) => Facing::Front(turned(n)),
            Facing::Both(n) => Facing::Both(turned(n)),
        };
        Self { facing, ..*self }
    }
}
