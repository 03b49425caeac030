use light_bounds::{LightSampleContext, ReceiverSides};
use light_math::float;
use light_math::glam::Vec3;

use super::glossy::GlossyReceiver;
use super::lane::Lane;
use super::segment::SegmentReceiver;

/// Coordinates are clamped to this on either side, so that no difference of two overflows.
pub(crate) const FAR: f32 = 1e36;

/// Round-off of a child's position, in units of the distance (see [`Lane`]): what a sound test has to leave.
const SLACK: f32 = 1e-5;

/// The same for emission, whose unit is the 127th part of the largest component of axis and offset.
const EMISSION_SLACK: f32 = 400.0 * SLACK;

/// How much of the variance of a height over the horizon counts, and how much of the emission ramp's variance by position and by
/// spread, and of the variance of the distance.
const HEIGHT: f32 = 0.45;
const RAMP_BY_POSITION: f32 = 0.03;
const RAMP_BY_SPREAD: f32 = 0.35;
pub(crate) const DISTANCE: f32 = 0.06;

/// Who asks a [`LightBvh`](crate::LightBvh), and what a group of lights is worth to it.
///
/// A policy may return 0 only when no light of the group can contribute: that test has to be sound. Everything else is an estimate.
pub trait Receiver: Copy {
    /// The point that groups are seen from.
    fn position(&self) -> Vec3;

    /// How far from [`position`](Self::position) the receiver reaches: 0 unless it is a segment.
    #[inline]
    fn reach(&self) -> f32 {
        0.0
    }

    /// About four times the group's irradiance, in units of its power over the squared `1 / inv_unit`.
    ///
    /// `inv_unit` converts lengths to those of the lane.
    fn weigh(&self, lane: &Lane, inv_unit: f32) -> f32;
}

/// A point on a surface that light reaches from the side of its normal only.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceReceiver {
    p: Vec3,
    n: Vec3,
}

impl SurfaceReceiver {
    /// The point `p` with the unit normal `n`.
    #[inline]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3) -> Self {
        Self { p: near(p), n }
    }

    /// About twice the mean height of the child's lights above the horizon, those below counting as 0.
    #[inline(always)]
    pub(crate) fn expected_height(&self, lane: &Lane) -> f32 {
        let (height, height_var, _) = lane.height(self.n);
        height + float::sqrt(height * height + (HEIGHT * height_var + SLACK * SLACK))
    }
}

impl Receiver for SurfaceReceiver {
    #[inline]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        let (height, _, support) = lane.height(self.n);
        let lit = (height + support > -SLACK) & lane.shines_here();
        masked(self.expected_height(lane) * lane.emitted(), lit)
    }
}

/// A point on a surface that light reaches from both sides.
#[derive(Clone, Copy, Debug)]
pub struct TwoSidedReceiver {
    p: Vec3,
    n: Vec3,
}

impl TwoSidedReceiver {
    /// The point `p` with the unit normal `n`.
    #[inline]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3) -> Self {
        Self { p: near(p), n }
    }
}

impl Receiver for TwoSidedReceiver {
    #[inline]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        let (height, height_var, _) = lane.height(self.n);
        let expected = float::sqrt(height * height + (HEIGHT * height_var + SLACK * SLACK));
        masked(2.0 * expected * lane.emitted(), lane.shines_here())
    }
}

/// A point in a medium, where light counts from all directions alike.
#[derive(Clone, Copy, Debug)]
pub struct MediumReceiver {
    p: Vec3,
}

impl MediumReceiver {
    /// The point `p`.
    #[inline]
    #[must_use]
    pub fn new(p: Vec3) -> Self {
        Self { p: near(p) }
    }
}

impl Receiver for MediumReceiver {
    #[inline]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        lane.fluence()
    }
}

/// Nobody in particular: groups count by their peak intensity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NoReceiver;

impl Receiver for NoReceiver {
    #[inline]
    fn position(&self) -> Vec3 {
        Vec3::ZERO
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        lane.power
    }
}

/// The receiver that a context stands for: a ray segment, a point in a medium, or a point on a surface by its shading normal.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ContextReceiver {
    Surface(SurfaceReceiver),
    Glossy(GlossyReceiver),
    TwoSided(TwoSidedReceiver),
    Medium(MediumReceiver),
    Segment(SegmentReceiver),
}

impl From<&LightSampleContext> for ContextReceiver {
    #[inline]
    fn from(ctx: &LightSampleContext) -> Self {
        if ctx.segment != Vec3::ZERO {
            return Self::Segment(SegmentReceiver::new(ctx.p, ctx.segment));
        }
        // Where coordinates had to be clamped, directions to lights mean nothing.
        if ctx.is_medium() || is_far(ctx.p) {
            return Self::Medium(MediumReceiver::new(ctx.p));
        }
        match (ctx.sides, &ctx.gloss) {
            (ReceiverSides::Front, None) => Self::Surface(SurfaceReceiver::new(ctx.p, ctx.ns)),
            (ReceiverSides::Front, Some(gloss)) => {
                Self::Glossy(GlossyReceiver::new(ctx.p, ctx.ns, gloss))
            }
            (ReceiverSides::Both, _) => Self::TwoSided(TwoSidedReceiver::new(ctx.p, ctx.ns)),
        }
    }
}

/// The same question for whichever receiver a context stands for.
macro_rules! for_receiver {
    ($ctx:expr, $receiver:ident => $answer:expr) => {
        match $crate::wide::importance::ContextReceiver::from($ctx) {
            $crate::wide::importance::ContextReceiver::Surface($receiver) => $answer,
            $crate::wide::importance::ContextReceiver::Glossy($receiver) => $answer,
            $crate::wide::importance::ContextReceiver::TwoSided($receiver) => $answer,
            $crate::wide::importance::ContextReceiver::Medium($receiver) => $answer,
            $crate::wide::importance::ContextReceiver::Segment($receiver) => $answer,
        }
    };
}
pub(crate) use for_receiver;

/// Whether `p` is beyond ±1e36 on any axis, where it is taken to be nearer and directions from it mean nothing.
#[inline]
#[must_use]
pub fn is_far(p: Vec3) -> bool {
    near(p) != p
}

#[inline]
pub(crate) fn near(p: Vec3) -> Vec3 {
    p.clamp(Vec3::splat(-FAR), Vec3::splat(FAR))
}

/// `x` where `there`, otherwise 0: without a branch, so that all lanes of a node are computed together.
#[inline(always)]
fn masked(x: f32, there: bool) -> f32 {
    let mask = if there { u32::MAX } else { 0 };
    f32::from_bits(x.to_bits() & mask)
}

impl Lane {
    /// Whether any of the child may emit toward the receiver's position. Sound there only: not for other places of a segment.
    #[inline(always)]
    fn shines_here(&self) -> bool {
        let [hx, hy, hz] = self.extent;
        let [vx, vy, vz] = self.mean;
        let [mx, my, mz] = self.axis;
        let along = -(mx * vx + my * vy + mz * vz + self.offset * self.dist);
        // From any point of the box the direction differs by less than the box is wide.
        let reach =
            mx.abs() * hx + my.abs() * hy + mz.abs() * hz + self.offset.abs() * (hx + hy + hz);
        (along + reach > -EMISSION_SLACK) | !self.sharp
    }

    /// The same child from a place `offset` away from the receiver's position.
    #[inline(always)]
    pub(crate) fn seen_from(&self, offset: Vec3) -> Self {
        let mean = Vec3::from(self.mean) - offset;
        let dist_sq = mean.length_squared() + 1e-12;
        Self {
            mean: mean.to_array(),
            dist_sq,
            dist: float::sqrt(dist_sq),
            ..*self
        }
    }

    /// What the child is worth to a point without a normal.
    #[inline(always)]
    pub(crate) fn fluence(&self) -> f32 {
        2.0 * self.dist * self.emitted()
    }

    /// Mean height over the plane through the receiver with normal `n`, its variance, and the highest point's excess over the mean.
    #[inline(always)]
    fn height(&self, n: Vec3) -> (f32, f32, f32) {
        let [hx, hy, hz] = self.extent;
        let [vx, vy, vz] = self.mean;
        let (sx, sy, sz) = (n.x.abs() * hx, n.y.abs() * hy, n.z.abs() * hz);
        (
            n.x * vx + n.y * vy + n.z * vz,
            sx * sx + sy * sy + sz * sz,
            sx + sy + sz,
        )
    }

    /// About twice the intensity toward the receiver over the distance to the fifth power and a half: everything but the cosine at
    /// the receiver.
    #[inline(always)]
    fn emitted(&self) -> f32 {
        let [hx, hy, hz] = self.extent;
        let [vx, vy, vz] = self.mean;
        let [mx, my, mz] = self.axis;
        let (d, o) = (self.dist, self.offset);
        let toward = -(mx * vx + my * vy + mz * vz + o * d) * d;
        let gx = (mx * d + o * vx) * hx;
        let gy = (my * d + o * vy) * hy;
        let gz = (mz * d + o * vz) * hz;
        let by_spread = self.spread * self.dist_sq;
        let variance = RAMP_BY_POSITION * (gx * gx + gy * gy + gz * gz)
            + RAMP_BY_SPREAD * (by_spread * by_spread);
        let root = float::sqrt(toward * toward + variance);
        let ramp = if self.both_sides { root } else { toward } + root;
        let fuzzy_dist_sq = self.dist_sq + DISTANCE * (hx * hx + hy * hy + hz * hz);
        self.power * ramp / (d * (fuzzy_dist_sq * fuzzy_dist_sq))
    }
}
