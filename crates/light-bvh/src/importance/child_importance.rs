use light_math::float;
use light_math::glam::Vec3;

use crate::importance::child_view::{ChildView, DISTANCE, dist_sq};
use crate::lane_math::{LaneMask, dot, larger, likely_above_zero};

/// How much of the squared width of one light counts as variance of its emission, in codes of the
/// axis. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const RAMP_BY_POSITION: f32 = 11.0;

/// The same of a group: where its emitters lie on both sides of the plane through the receiver,
/// those in front count although the mean is behind. Chosen by V.
pub(crate) const GROUP_BY_POSITION: f32 = 400.0;

/// The length of the axis of one light that emits in a step, 127 codes, and a little more: so that
/// something is left of `UNIT - offset` for the narrowest cones, whose offset rounds to 127.
pub(crate) const UNIT: f32 = 127.25;

/// How much more a child counts where its width is its distance. Chosen by V.
pub(crate) const NEARNESS: f32 = 0.2;

/// How far what is emitted beyond the edge may differ between two points of a box, over the sum of
/// its half extents.
///
/// The product with the axis differs by at most its largest component, 127, times that sum, and the
/// offset's by 127 times a length that is no longer. The mean distance exceeds that of the mean
/// position by at most 0.3 of the sum: 127 (2 + 0.3) < 293. An emitter in the corner of a cube,
/// beside a receiver in the cube, needs 210.
pub(crate) const BOX_EMISSION: f32 = 297.0;

/// How far beyond the mean edge of a spot it may emit, in codes, over its spread.
///
/// Half the width of the rim over the spread, which is rounded up, is the root of 5. Rounding of
/// axis and offset moves the edge by half the diagonal of a cube and half a code, 1.3661, which is
/// 2.6291 of the least spread. A flat light ends at its edge: it is given as much.
pub(crate) const STEP_EDGE: f32 = 4.87;

/// How far the weight of a subtree may be off, as a share of the weights of its node: one that may be
/// off by more is looked into. Chosen by V and by time: see `docs/light-bvh-study.md`.
pub(crate) const DOUBT: f32 = 0.2;

/// How many times the squared distance from a box its squared width is at least, where a receiver is
/// beside it. Chosen by V: see `docs/light-bvh-study.md`.
pub(crate) const BESIDE: f32 = 4.0;

/// How many times its variance the square of an emission or of a height is at least, and the squared
/// distance the squared width, where the lights of a group may count by their powers alone. Chosen
/// by V and by time: see `docs/light-bvh-study.md`.
#[cfg(feature = "alloc")]
pub(crate) const FAR_SQ: f32 = 16.0;

/// From a point to a child.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Displacement {
    /// The inner product of its axis and the way to its mean position, as [`ChildView::toward`] has it.
    pub(crate) axis_dot_mean: f32,
    /// About the root mean square distance, and its square.
    pub(crate) dist: f32,
    pub(crate) dist_sq: f32,
}

impl ChildView {
    /// From the receiver's position.
    #[inline(always)]
    pub(crate) const fn displacement(&self) -> Displacement {
        Displacement {
            axis_dot_mean: self.axis_dot_mean,
            dist: self.dist,
            dist_sq: self.dist_sq,
        }
    }

    /// Whether any light of the child may emit toward the receiver's position. Sound there only:
    /// not for other points of a segment.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(all(target_os = "none", not(soft_floats)), inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn may_reach(&self) -> LaneMask {
        let beyond = self.beyond(&self.displacement());
        // Round-off is less than 0.001 times the distance, which the codes leave: see their
        // margins.
        let edge = (STEP_EDGE * self.spread) * self.dist;
        let within = LaneMask::when(beyond < BOX_EMISSION * self.width() + edge);
        // The mean of lights that differ proves nothing.
        within.or(self.soft).or(self.both_sides)
    }

    /// Whether a point gets from each light of the child about the same share of its power: from a
    /// group of ramps that is far away and faces the point.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn is_uniform(&self) -> bool {
        let width_sq = self.width_sq();
        let beyond = self.beyond(&self.displacement());
        let variance = self.emission_variance(width_sq, self.dist_sq);
        self.is_ramp_group().and_not(self.both_sides).is_set()
            && beyond < 0.0
            && FAR_SQ * width_sq < self.dist_sq
            && FAR_SQ * variance < beyond * beyond
    }

    /// How much of the squared width of a child that emits in a step counts as variance: the solid
    /// angle of its cap.
    #[inline(always)]
    fn cap(&self) -> f32 {
        (0.25 * UNIT) * (UNIT - self.offset)
    }

    /// The sum of the half extents.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    fn width(&self) -> f32 {
        let [hx, hy, hz] = self.extent;
        hx + hy + hz
    }

    /// The squared width.
    #[inline(always)]
    pub(crate) fn width_sq(&self) -> f32 {
        let width = self.width();
        width * width
    }

    /// By how much the mean emission misses a point, times the distance: negative where it reaches.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    fn beyond(&self, from: &Displacement) -> f32 {
        from.axis_dot_mean + self.offset * from.dist
    }

    /// The variance of that: by the positions of the lights, and by their axes and offsets.
    #[inline(always)]
    fn emission_variance(&self, width_sq: f32, dist_sq: f32) -> f32 {
        let ramp = self.soft.select(GROUP_BY_POSITION, RAMP_BY_POSITION);
        let by_position = self.step.select(self.cap(), ramp);
        by_position * width_sq + (self.spread * self.spread) * dist_sq
    }

    /// The root of the square of `beyond` and its variance.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    fn root(&self, beyond: f32, width_sq: f32, dist_sq: f32) -> f32 {
        let variance = self.emission_variance(width_sq, dist_sq);
        float::sqrt(beyond * beyond + variance)
    }

    /// Above 0 where the weight of a group may be off by more than [`DOUBT`], if it is `share` of the
    /// weights of its node.
    ///
    /// Of a step the receiver gets all that lights so far away may give with a probability of about
    /// [`f`](Self::likelihood), and otherwise nothing. One standard deviation of that is
    /// `sqrt((1 - f) / f)` times the mean, which is the weight. A ramp is taken to be off by its
    /// squared angular size, squared width over squared distance.
    #[inline(always)]
    pub(crate) fn doubt(&self, share: f32) -> f32 {
        let beyond = self.beyond(&self.displacement());
        let width_sq = self.width_sq();
        let root = self.root(beyond, width_sq, self.dist_sq);
        let doubt = self.step.select(share * (root + beyond), width_sq);
        let unit = self.step.select(DOUBT * (root - beyond), self.dist_sq);
        share * doubt - DOUBT * unit
    }

    /// Above 0 where the receiver is nearer to the box than half of its width: the middle of lights
    /// along a line then tells little.
    #[inline(always)]
    pub(crate) fn beside(&self) -> f32 {
        let mut away_sq = 0.0;
        for (mean, half) in self.mean.iter().zip(&self.extent) {
            let away = larger(0.0, mean.abs() - half);
            away_sq += away * away;
        }
        self.width_sq() - BESIDE * away_sq
    }

    /// How likely it is that some light of the child is emitted toward the receiver's position:
    /// `(1 - beyond / root) / 2`.
    #[cfg_attr(soft_floats, inline(never))]
    pub(crate) fn likelihood(&self) -> f32 {
        let beyond = self.beyond(&self.displacement());
        let root = self.root(beyond, self.width_sq(), self.dist_sq);
        self.both_sides
            .select(1.0, likely_above_zero(-beyond, root))
    }

    /// Whether the child is a group of lights none of which emits in a step.
    #[inline(always)]
    pub(crate) const fn is_ramp_group(&self) -> LaneMask {
        self.soft.and_not(self.step)
    }

    /// From a point `offset` away from the receiver's position, and no nearer than the root of
    /// `least_sq`.
    #[inline(always)]
    pub(crate) fn displacement_at(&self, offset: Vec3, least_sq: f32) -> Displacement {
        let mean = (Vec3::from(self.mean) - offset).to_array();
        let dist_sq = dist_sq(mean, self.extent, DISTANCE);
        let dist_sq = larger(least_sq, dist_sq);
        Displacement {
            axis_dot_mean: self.toward(dot(&self.axis, &mean)),
            dist: float::sqrt(dist_sq),
            dist_sq,
        }
    }

    /// The importance of the child to a point without a normal, from which it is so far.
    #[inline(always)]
    pub(crate) fn fluence(&self, from: &Displacement) -> f32 {
        self.weight(from, from.dist, 0.0)
    }

    /// The importance of the child to a point, from which it is so far, over whose horizon it is at
    /// `height`. `lift` is `dot(axis, mean above the horizon - mean)`: it is added to `beyond`, which
    /// is `dot(axis, mean) + offset * distance`, negative where the child emits to the receiver.
    ///
    /// A ramp emits `max(0, -beyond)`, half of the root less `beyond` where these vary. A step
    /// emits where `beyond` is below 0: half of `1 - beyond / root`. Where positions vary by
    /// `width` a step varies by the solid angle of its cap, `2 pi (1 - cos)`, so that the flux of
    /// a beam stays about what it is.
    #[cfg_attr(target_os = "none", inline)]
    #[cfg_attr(not(target_os = "none"), inline(always))]
    pub(crate) fn weight(&self, from: &Displacement, height: f32, lift: f32) -> f32 {
        // The emission times the distance: all divisions come at the end.
        let beyond = self.beyond(from) + lift;
        let width_sq = self.width_sq();
        let root = self.root(beyond, width_sq, from.dist_sq);
        let ramp = root - self.both_sides.clear(beyond);
        let scale = self.step.select(UNIT * from.dist / root, 1.0);
        let inv_dist_sq = 1.0 / from.dist_sq;
        // One near light may outshine all others of its group.
        let near = 1.0 + NEARNESS * (width_sq * inv_dist_sq);
        (((self.power * inv_dist_sq) * (height * inv_dist_sq)) * near) * (ramp * scale)
    }
}
