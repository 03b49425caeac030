use light_math::glam::Vec3;
use light_math::{direction, float};

use crate::importance::child_view::{Lane, dist_sq};

/// Coordinates are clamped to this on either side, so that no difference of two overflows.
pub(crate) const FAR: f32 = 1e36;

/// How much of the squared support of a child counts as variance of its height over the horizon, and how much of the support is taken off
/// again, for no light is beyond it; how much of its squared width, and of its squared spread and distance, as variance of its emission, in
/// codes of the axis; how much of its squared width as variance of its distance, and how much more it is worth where its width is that
/// distance. Chosen by V: see the crate's first page.
const HEIGHT: f32 = 0.35;
const BEYOND: f32 = 0.14;
const RAMP_BY_POSITION: f32 = 11.0;
const RAMP_BY_SPREAD: f32 = 0.27;
pub(crate) const DISTANCE: f32 = 0.09;
const NEARNESS: f32 = 0.28;

/// How far what is emitted beyond the edge may differ between two points of a box, over the sum of its half extents.
///
/// The product with the axis differs by at most its largest component, 127, times that sum, and the offset's by 127 times a length that is no
/// longer. The mean distance exceeds that of the mean position by at most 0.3 of the sum, and by a hundredth of a code, a 300th of the least
/// sum: 127 (2 + 0.3 + 0.0034) < 293. An emitter in the corner of a cube, beside a receiver in the cube, needs 210.
const BOX_EMISSION: f32 = 297.0;

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
    /// `inv_unit` converts lengths to those of the lane. To be computed for all children together it has to be `#[inline]`, without
    /// branches.
    fn weigh(&self, lane: &Lane, inv_unit: f32) -> f32;
}

/// A point on a surface that light reaches from the side of its normal only.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceReceiver {
    p: Vec3,
    horizon: Horizon,
}

impl SurfaceReceiver {
    /// The point `p` with the normal `n`, of any length; one without a direction has no horizon.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3) -> Self {
        Self::facing(p, direction(n).unwrap_or(Vec3::ZERO))
    }

    /// The point `p` with the unit normal `n`.
    #[inline(always)]
    pub(crate) fn facing(p: Vec3, n: Vec3) -> Self {
        Self {
            p: near(p),
            horizon: Horizon::new(n),
        }
    }

    /// About twice the mean height of the child's lights above the horizon, those below counting as 0.
    #[inline(always)]
    pub(crate) fn expected_height(&self, lane: &Lane) -> f32 {
        let (height, support) = self.horizon.height(lane);
        at_least(lane.slack, height + expected_abs(height, support))
    }
}

impl Receiver for SurfaceReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        let (height, support) = self.horizon.height(lane);
        let lit = (height + support > -lane.slack) & lane.shines_here();
        masked(lane.weight(self.expected_height(lane)), lit)
    }
}

/// A point on a surface that light reaches from both sides.
#[derive(Clone, Copy, Debug)]
pub struct TwoSidedReceiver {
    p: Vec3,
    horizon: Horizon,
}

impl TwoSidedReceiver {
    /// The point `p` with the normal `n`, of any length.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3, n: Vec3) -> Self {
        Self::facing(p, direction(n).unwrap_or(Vec3::ZERO))
    }

    /// The point `p` with the unit normal `n`.
    #[inline(always)]
    pub(crate) fn facing(p: Vec3, n: Vec3) -> Self {
        Self {
            p: near(p),
            horizon: Horizon::new(n),
        }
    }
}

impl Receiver for TwoSidedReceiver {
    #[inline(always)]
    fn position(&self) -> Vec3 {
        self.p
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        let (height, support) = self.horizon.height(lane);
        let expected = at_least(lane.slack, expected_abs(height, support));
        masked(lane.weight(2.0 * expected), lane.shines_here())
    }
}

/// A point in a medium, where light counts from all directions alike.
#[derive(Clone, Copy, Debug)]
pub struct MediumReceiver {
    p: Vec3,
}

impl MediumReceiver {
    /// The point `p`.
    #[inline(always)]
    #[must_use]
    pub fn new(p: Vec3) -> Self {
        Self { p: near(p) }
    }
}

impl Receiver for MediumReceiver {
    #[inline(always)]
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
    #[inline(always)]
    fn position(&self) -> Vec3 {
        Vec3::ZERO
    }

    #[inline(always)]
    fn weigh(&self, lane: &Lane, _: f32) -> f32 {
        lane.power
    }
}

/// The plane through a receiver, with its normal up.
#[derive(Clone, Copy, Debug)]
struct Horizon {
    n: Vec3,
    abs_n: Vec3,
}

impl Horizon {
    #[inline(always)]
    fn new(n: Vec3) -> Self {
        Self { n, abs_n: n.abs() }
    }

    /// Mean height over the plane, and by how much the highest point of the box may exceed it.
    #[inline(always)]
    fn height(&self, lane: &Lane) -> (f32, f32) {
        let Self { n, abs_n } = self;
        let [vx, vy, vz] = lane.mean;
        let [hx, hy, hz] = lane.extent;
        (
            n.x * vx + n.y * vy + n.z * vz,
            abs_n.x * hx + abs_n.y * hy + abs_n.z * hz,
        )
    }
}

/// Whether `p` is beyond ±1e36 on any axis, where it is taken to be nearer and directions from it mean nothing.
#[inline(always)]
#[must_use]
pub fn is_far(p: Vec3) -> bool {
    near(p) != p
}

#[inline(always)]
pub(crate) fn near(p: Vec3) -> Vec3 {
    p.clamp(Vec3::splat(-FAR), Vec3::splat(FAR))
}

/// `x` where `there`, otherwise 0: without a branch, so that all lanes of a node are computed together.
#[inline(always)]
fn masked(x: f32, there: bool) -> f32 {
    let mask = if there { u32::MAX } else { 0 };
    f32::from_bits(x.to_bits() & mask)
}

/// The larger of the two; `x` if it is NaN.
#[inline(always)]
pub(crate) fn at_least(least: f32, x: f32) -> f32 {
    if x < least { least } else { x }
}

/// The smaller of the two; `x` if it is NaN.
#[inline(always)]
pub(crate) fn at_most(most: f32, x: f32) -> f32 {
    if x > most { most } else { x }
}

/// About the mean distance from the horizon, up or down, of lights whose height varies as `support` allows: more than `-height` even where
/// the support just reaches the horizon.
#[inline(always)]
fn expected_abs(height: f32, support: f32) -> f32 {
    float::sqrt(height * height + HEIGHT * (support * support)) - BEYOND * support
}

impl Lane {
    /// Whether any of the child may emit toward the receiver's position. Sound there only: not for other places of a segment.
    #[inline(always)]
    fn shines_here(&self) -> bool {
        let [hx, hy, hz] = self.extent;
        let [vx, vy, vz] = self.mean;
        let [mx, my, mz] = self.axis;
        let beyond = mx * vx + my * vy + mz * vz + self.offset * self.dist;
        // Round-off is less than 0.001 times the distance, which the code of the offset leaves: see its margin.
        // A child whose lights differ is never given up.
        (beyond < BOX_EMISSION * (hx + hy + hz)) | (self.spread > 0.0)
    }

    /// The same child from a place `offset` away from the receiver's position, and no nearer than the root of `least_sq`.
    #[inline(always)]
    pub(crate) fn seen_from(&self, offset: Vec3, least_sq: f32) -> Self {
        let mean = (Vec3::from(self.mean) - offset).to_array();
        let dist_sq = dist_sq(mean, self.extent, DISTANCE, self.slack * self.slack);
        let dist_sq = at_least(least_sq, dist_sq);
        Self {
            mean,
            dist_sq,
            dist: float::sqrt(dist_sq),
            ..*self
        }
    }

    /// What the child is worth to a point without a normal.
    #[inline(always)]
    pub(crate) fn fluence(&self) -> f32 {
        self.weight(2.0 * self.dist)
    }

    /// What the child is worth to a point over whose horizon it is at half of `height`.
    #[inline(always)]
    fn weight(&self, height: f32) -> f32 {
        let [hx, hy, hz] = self.extent;
        let [vx, vy, vz] = self.mean;
        let [mx, my, mz] = self.axis;
        // All of the emission times the distance, which is not divided by before the end.
        let beyond = (mx * vx + my * vy + mz * vz) + self.offset * self.dist;
        let width = hx + hy + hz;
        let variance = RAMP_BY_POSITION * (width * width)
            + RAMP_BY_SPREAD * (self.spread * self.spread + 1.0) * self.dist_sq;
        let ramp = float::sqrt(beyond * beyond + variance) - masked(beyond, !self.both_sides);
        let inv_dist_sq = 1.0 / self.dist_sq;
        // One near light may outshine all others of its group.
        let near = 1.0 + NEARNESS * (width * width * inv_dist_sq);
        (((self.power * inv_dist_sq) * (height * inv_dist_sq)) * near) * ramp
    }
}
