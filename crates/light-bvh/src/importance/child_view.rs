use light_math::float::{self, inverse_power_of_two};
use light_math::glam::Vec3;

use crate::lane_math::{LaneMask, dot};
use crate::node::child_codes::{ChildCodes, READS_WORDS};
use crate::node::sheet_code::SheetCode;
use crate::node::spread_code::SpreadCode;
use crate::node::wide_node::{BOTH_SIDES, WideNode, decode_power};

/// How much of a child's squared width counts as variance of its distance. Chosen by V: see
/// `docs/light-bvh-study.md`.
pub(crate) const DISTANCE: f32 = 0.09;

/// Round-off of a position, as a share of its distance: of coordinates, and of products with them.
/// What they round as codes of a node is in the margin of the boxes.
pub(crate) const ROUND_OFF: f32 = 1e-5;

/// A child of a node as a receiver sees it.
///
/// Lengths are in a unit of the node's choice, in which no power of them that a weight needs
/// overflows or vanishes.
#[derive(Clone, Copy, Debug)]
pub struct ChildView {
    /// From the receiver to the mean position.
    pub mean: [f32; 3],
    /// Half extents of a box about that position that holds all emitting points.
    pub extent: [f32; 3],
    /// About the root mean square distance of the emitting points, above 0 and not below the length
    /// of `mean`.
    pub dist: f32,
    /// Its square.
    pub dist_sq: f32,
    /// Round-off that `mean` may have: what a sound test has to leave.
    pub slack: f32,
    /// Mean emission axis, no component of which is above 127.
    pub axis: [f32; 3],
    /// Mean emission offset, of `[-127, 127]`: a child that is no step emits about
    /// `power * max(0, dot(axis, w) - offset)` toward a unit vector `w`.
    pub offset: f32,
    /// Root of the variance of the emission: of axis and offset, and of their codes.
    pub spread: f32,
    /// Whether some light of the child may emit beyond the edge that axis, offset and spread tell:
    /// all but single flat lights and single spots.
    pub(crate) soft: LaneMask,
    /// Whether the child emits in a step: `power` toward a unit vector `w` where `dot(axis, w)` is
    /// above the offset, and nothing elsewhere, with an edge as wide as `spread`.
    pub(crate) step: LaneMask,
    /// Whether the child emits alike to both sides, about `power / 2 * |dot(axis, w)|`.
    pub(crate) both_sides: LaneMask,
    /// The sign bit where the child is a group of beams that go both ways along `axis`.
    pub(crate) opposed: u32,
    /// Scale of the emission; 0 for an empty slot.
    pub power: f32,
    /// How it lies, if it is a thin sheet; `None` if no child of the node is one.
    pub(crate) sheet: Option<Sheet>,
    /// What [`toward`](Self::toward) has for the way to `mean`, which several tests and weights need.
    pub(crate) axis_dot_mean: f32,
}

/// A child whose lights lie in a thin slanted sheet, if they do.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sheet {
    pub(crate) is_sheet: LaneMask,
    /// Of x and y, y and z, z and x.
    pub(crate) correlations: [f32; 3],
}

/// Where a receiver sees the children of a node, and in which unit of length.
pub(crate) struct NodeFrame {
    origin: Vec3,
    /// The length of a code.
    code: f32,
    /// One over the unit of length.
    pub(crate) inv_unit: f32,
}

impl NodeFrame {
    /// A code of the node is the unit: the quickest.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    pub(crate) fn in_codes(node: &WideNode, position: Vec3) -> Self {
        Self {
            origin: (Vec3::from(node.origin) - position) * node.inv_scale,
            code: 1.0,
            inv_unit: node.inv_scale,
        }
    }

    /// The unit is near the distance to the node or its extent, whichever is larger: right for all
    /// finite lengths.
    pub(crate) fn from_afar(node: &WideNode, position: Vec3, reach: f32) -> Self {
        let origin = Vec3::from(node.origin) - position;
        let away = origin.abs().element_sum() + reach;
        let inv_unit = inverse_power_of_two(away.max(256.0 / node.inv_scale));
        Self {
            origin: origin * inv_unit,
            code: inv_unit / node.inv_scale,
            inv_unit,
        }
    }

    /// Whether a receiver that reaches so far is near enough that no weight in codes vanishes.
    ///
    /// A power is at least 2^-34. In codes, all lengths that a weight is made of are of
    /// `[0.5, 2^24]`: it is their power of -2, times at least 10^-5 for a light on the horizon,
    /// 10^-3 at the edge of its emission and 0.02 for gloss; for a segment 10^-3 of that edge and
    /// 10^-6 over two such lengths. All are above 2^-116, and their products, which start with the
    /// power, above 2^-124.
    #[inline(always)]
    pub(crate) fn is_near(&self, reach: f32) -> bool {
        self.origin.abs().element_sum() + reach * self.inv_unit < 8_388_608.0
    }

    /// Child `k` of `node`, which has `rare` ones or none.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    pub(crate) fn child_at(&self, node: &WideNode, k: usize, rare: bool) -> ChildView {
        let codes = if READS_WORDS {
            node.four_children(k / 4).child_codes(k % 4)
        } else {
            node.child_codes(k)
        };
        self.child(&codes, rare)
    }

    /// The child of these codes, of a node that has `rare` ones or none.
    // Software floats take much code.
    #[cfg_attr(soft_floats, inline(never))]
    #[cfg_attr(not(soft_floats), inline(always))]
    pub(crate) fn child(&self, codes: &ChildCodes, rare: bool) -> ChildView {
        let Self { origin, code, .. } = *self;
        let mean = [
            origin.x + code * f32::from(codes.mean[0]),
            origin.y + code * f32::from(codes.mean[1]),
            origin.z + code * f32::from(codes.mean[2]),
        ];
        let extent = [
            code * f32::from(codes.extent[0]),
            code * f32::from(codes.extent[1]),
            code * f32::from(codes.extent[2]),
        ];
        let axis = [
            f32::from(codes.axis[0]),
            f32::from(codes.axis[1]),
            f32::from(codes.axis[2]),
        ];
        let dist_sq = dist_sq(mean, extent, DISTANCE);
        let dist = float::sqrt(dist_sq);
        let offset = i32::from(codes.offset);
        let both_sides = LaneMask::when(offset == i32::from(BOTH_SIDES));
        let spread = SpreadCode(codes.spread);
        let mut child = ChildView {
            mean,
            extent,
            dist,
            dist_sq,
            slack: ROUND_OFF * dist,
            axis,
            offset: both_sides.clear(offset as f32),
            spread: spread.value(),
            soft: spread.soft(),
            step: spread.step(),
            both_sides,
            opposed: 0,
            power: decode_power(codes.power),
            sheet: None,
            axis_dot_mean: dot(&axis, &mean),
        };
        if rare {
            child.set_rare(codes);
        }
        child
    }
}

impl ChildView {
    /// Sets what only the codes of a node that has rare children tell: whether this one is a sheet, and
    /// whether its beams are opposed.
    #[inline(always)]
    fn set_rare(&mut self, codes: &ChildCodes) {
        let is_sheet = self.is_ramp_group().and(LaneMask::when(self.offset > 0.0));
        self.sheet = Some(Sheet {
            is_sheet,
            correlations: SheetCode::correlations(i32::from(codes.offset)),
        });
        self.offset = is_sheet.clear(self.offset);
        let is_odd = LaneMask::of_sign(i32::from(codes.offset) << 31);
        self.opposed = self.step.and(self.soft).and(is_odd).sign();
        self.axis_dot_mean = self.toward(self.axis_dot_mean);
    }

    /// `axis_dot_way`, the inner product of the axis and a way to the lights: negative where they emit to
    /// its beginning. Opposed beams emit both ways.
    #[inline(always)]
    pub(crate) const fn toward(&self, axis_dot_way: f32) -> f32 {
        f32::from_bits(axis_dot_way.to_bits() | self.opposed)
    }
}

/// The mean squared distance of a box about `mean`, `share` of whose squared width counts as variance.
/// Above 0, because no extent is 0.
#[cfg_attr(soft_floats, inline(never))]
#[cfg_attr(not(soft_floats), inline(always))]
pub(crate) fn dist_sq(mean: [f32; 3], extent: [f32; 3], share: f32) -> f32 {
    let [x, y, z] = mean;
    let width = extent[0] + extent[1] + extent[2];
    (x * x + y * y) + (z * z + share * (width * width))
}
