use light_math::float;
use light_math::glam::Vec3;

use crate::importance::child_view::{ChildView, DISTANCE, dist_sq};
use crate::lane_math::{larger, masked};

/// How much of a child's squared width counts as variance of its emission, in codes of the axis.
/// Chosen by V: see `docs/light-bvh.md`.
const RAMP_BY_POSITION: f32 = 11.0;

/// How much of its squared spread and distance counts as variance of its emission. Chosen by V.
const RAMP_BY_SPREAD: f32 = 0.27;

/// How much more a child counts where its width is its distance. Chosen by V.
const NEARNESS: f32 = 0.28;

/// How far what is emitted beyond the edge may differ between two points of a box, over the sum of
/// its half extents.
///
/// The product with the axis differs by at most its largest component, 127, times that sum, and the
/// offset's by 127 times a length that is no longer. The mean distance exceeds that of the mean
/// position by at most 0.3 of the sum, and by a hundredth of a code, a 300th of the least sum: 127
/// (2 + 0.3 + 0.0034) < 293. An emitter in the corner of a cube, beside a receiver in the cube,
/// needs 210.
const BOX_EMISSION: f32 = 297.0;

impl ChildView {
    /// Whether any light of the child may emit toward the receiver's position. Sound there only:
    /// not for other points of a segment.
    #[inline(always)]
    pub(crate) fn may_reach(&self) -> bool {
        let [hx, hy, hz] = self.extent;
        let [vx, vy, vz] = self.mean;
        let [mx, my, mz] = self.axis;
        let beyond = mx * vx + my * vy + mz * vz + self.offset * self.dist;
        // Round-off is less than 0.001 times the distance, which the code of the offset leaves: see
        // its margin. A spread above 0 means that lights differ: the line of their mean proves
        // nothing.
        (beyond < BOX_EMISSION * (hx + hy + hz)) | (self.spread > 0.0)
    }

    /// The same child as seen from a point `offset` away from the receiver's position, and no
    /// nearer than the root of `least_sq`.
    #[inline(always)]
    pub(crate) fn at_offset(&self, offset: Vec3, least_sq: f32) -> Self {
        let mean = (Vec3::from(self.mean) - offset).to_array();
        let dist_sq = dist_sq(mean, self.extent, DISTANCE, self.slack * self.slack);
        let dist_sq = larger(least_sq, dist_sq);
        Self {
            mean,
            dist_sq,
            dist: float::sqrt(dist_sq),
            ..*self
        }
    }

    /// The importance of the child to a point without a normal.
    #[inline(always)]
    pub(crate) fn fluence(&self) -> f32 {
        self.weight(2.0 * self.dist)
    }

    /// The importance of the child to a point over whose horizon it is at half of `height`.
    #[inline(always)]
    pub(crate) fn weight(&self, height: f32) -> f32 {
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
