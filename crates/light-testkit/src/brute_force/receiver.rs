use light_bounds::{Gloss, LightSampleContext};
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
        let mut own = Rng::new(rng.clone().u64());
        let distance = p.distance(toward);
        let error = random_error(&mut own, p, distance);
        let receiver = Self::exact(rng, p, toward);
        let ctx = match (receiver.facing, own.below(2)) {
            (Facing::All, 0) => {
                let length = distance * own.log_range(0.1, 10.0);
                LightSampleContext::segment(p, own.direction() * length)
            }
            (Facing::Front(_), 0) => receiver.ctx.with_gloss(random_gloss(&mut own)),
            _ => receiver.ctx,
        };
        Self {
            ctx: ctx.with_error(error),
            ..receiver
        }
    }

    /// A receiver without gloss, of which the place is known exactly.
    fn exact(rng: &mut Rng, p: Vec3, toward: Vec3) -> Self {
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

    /// Segments through a point that receives from all directions: light that reaches the point
    /// reaches them.
    pub(super) fn segments(&self, rng: &mut Rng) -> Option<[LightSampleContext; 2]> {
        let length = rng.log_range(1e-2, 1e2) * (1e-3 + self.ctx.p.length());
        let along = rng.direction() * length;
        let through = |part: f32| LightSampleContext::segment(self.ctx.p - along * part, along);
        matches!(self.facing, Facing::All).then(|| [through(0.5), through(rng.f32())])
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

/// Half widths of the box of a point: none, some roundings, or up to a hundredth of the distance of
/// the light.
fn random_error(rng: &mut Rng, p: Vec3, distance: f32) -> Vec3 {
    let size = match rng.below(3) {
        0 => return Vec3::ZERO,
        1 => p.length() * f32::EPSILON * rng.range(1.0, 16.0),
        _ => distance * rng.log_range(1e-6, 1e-2),
    };
    rng.vec3() * size
}

fn random_gloss(rng: &mut Rng) -> Gloss {
    Gloss {
        wo: rng.direction(),
        alpha: rng.log_range(1e-3, 1.0),
        diffuse: [0.0, rng.f32()][rng.below(2)],
    }
}
