use core::ops::Range;

#[cfg(feature = "alloc")]
use light_math::Aabb;
#[cfg(feature = "alloc")]
use light_math::glam::Vec3;

/// Children of a node.
pub(crate) const WIDTH: usize = 16;

/// Levels of nodes that a tree may have: the builder keeps to it whatever the lights are.
pub const MAX_DEPTH: usize = 24;

/// `slots` entry of a light that is not in the tree, and `parent` of the root.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// A node of the default tree: up to sixteen children, each a subtree or one light, described by
/// 8-bit moments.
///
/// Lengths are in codes, of which `inv_scale` make a unit. A child's emission toward a unit vector
/// `w` is a ramp, about `power * max(0, dot(axis, w) - offset)`, or a step, about `power` where
/// `dot(axis, w) > offset`; both are blurred by its `spread`. The three share a unit, that of a
/// ramp is folded into `power`, that of a step is 1/127. A child is a step if a light of it has a
/// narrow cone. The first `inner` children are subtrees, in the nodes `child_base..`; the others
/// are lights, in the order entries `light_base..`.
///
/// Aligned so that none is on more than four cache lines.
///
/// | byte | field | |
/// | --- | --- | --- |
/// | 0 | `mean[axis][child]` | mean position: `origin + mean / inv_scale` |
/// | 48 | `extent[axis][child]` | half extents of a box about that position, at least 1 |
/// | 96 | `axis[axis][child]` | mean emission axis, signed |
/// | 144 | `offset[child]` | mean emission offset, signed; -128: to both sides alike; or a sheet |
/// | 160 | `spread[child]` | bit 7: a step; bit 6: soft; below, a deviation |
/// | 176 | `power[child]` | relative to `gain`; 0 for an empty slot |
/// | 192 | `origin` | |
/// | 204 | `inv_scale` | |
/// | 208 | `child_base` | |
/// | 212 | `light_base` | |
/// | 216 | `gain` | upper half of an `f32`: the largest share of a child; its top bits: two flags |
/// | 218 | `inner` | |
/// | 219 | `count` | children in all; bit 7: its lights lie along a line |
/// | 220 | `parent` | `16 * node + child`; all ones at the root |
///
/// The box holds the child's lights. A child that emits to both sides alike has offset 0 and its
/// power doubled. A child is soft if it is anything but one flat light or one spot. The deviation
/// of axis and offset has six bits, of which three are the exponent: 0.52 to 122. A power has five
/// bits of exponent and three of mantissa, less their value for 0.
///
/// The share of a child is that of the tree's power. It is below 2, so that two bits of `gain` are
/// free: bit 15 is set where a child is rare, a sheet or a group of opposed beams, bit 14 where a
/// subtree is rough, so that its own node may tell more. It is small, its extents are 1 in codes, or
/// at most 15 where its power is at most a 1024th of the largest; or its lights emit in steps; or they
/// lie along a line; or they are many, of a node whose lights all face about the same way.
///
/// A group of flat lights that lie in a thin slanted sheet has offset 0, and the byte tells instead
/// how positions along the axes are correlated: as `63 + 25 a + 5 b + c`, of which `a`, `b` and `c`
/// are -2 to 2, for x and y, y and z, z and x. No offset of a group of ramps is above 0 otherwise.
///
/// In a node that has rare children the offset of a group of steps is odd if its beams are opposed: they
/// go both ways along `axis`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C, align(32))]
#[allow(missing_docs, reason = "the table above documents every field")]
pub struct WideNode {
    pub mean: [[u8; WIDTH]; 3],
    pub extent: [[u8; WIDTH]; 3],
    pub axis: [[i8; WIDTH]; 3],
    pub offset: [i8; WIDTH],
    pub spread: [u8; WIDTH],
    pub power: [u8; WIDTH],
    pub origin: [f32; 3],
    pub inv_scale: f32,
    pub child_base: u32,
    pub light_base: u32,
    pub gain: u16,
    pub inner: u8,
    pub count: u8,
    pub parent: u32,
}

const _: () = {
    use core::mem::offset_of;
    assert!(size_of::<WideNode>() == 224, "no padding");
    assert!(offset_of!(WideNode, axis) == 96, "as documented");
    assert!(offset_of!(WideNode, power) == 176, "as documented");
    assert!(offset_of!(WideNode, child_base) == 208, "as documented");
    assert!(offset_of!(WideNode, parent) == 220, "as documented");
};

/// The offset that marks a child that emits alike to both sides.
pub(crate) const BOTH_SIDES: i8 = i8::MIN;

/// The bit of [`WideNode::gain`] that is set where a child is a sheet, or a group of opposed beams.
pub(crate) const HAS_RARE: u16 = 1 << 15;

/// The bit of [`WideNode::gain`] that is set where a subtree is rough: small in codes of the node, of
/// lights that emit in steps or lie along a line, or of many in a node whose lights face about the same
/// way.
pub(crate) const HAS_ROUGH: u16 = 1 << 14;

/// The bit of [`WideNode::count`] that is set where the lights of a node lie along a line.
const ALONG_LINE: u8 = 1 << 7;

/// The largest extent of a faint subtree that is small. All bits are set: the bits of three extents
/// together are above it where one of them is.
pub(crate) const SMALL_EXTENT: u8 = 15;

/// The code of the power up to which a subtree is faint: a 1024th of the largest.
pub(crate) const FAINT_POWER: u8 = 21 << 3;

impl WideNode {
    /// A node without children.
    pub const EMPTY: Self = Self {
        mean: [[0; WIDTH]; 3],
        extent: [[1; WIDTH]; 3],
        axis: [[0; WIDTH]; 3],
        offset: [0; WIDTH],
        spread: [0; WIDTH],
        power: [0; WIDTH],
        origin: [0.0; 3],
        inv_scale: 1.0,
        child_base: 0,
        light_base: 0,
        gain: 0,
        inner: 0,
        count: 0,
        parent: NOWHERE,
    };

    /// The largest power of a child, as a share of the tree's.
    #[inline]
    #[must_use]
    pub(crate) const fn gain(&self) -> f32 {
        f32::from_bits(((self.gain & !(HAS_RARE | HAS_ROUGH)) as u32) << 16)
    }

    /// Whether a child may be a group of lights in a thin slanted sheet, or of opposed beams.
    #[inline(always)]
    pub(crate) const fn has_rare(&self) -> bool {
        self.gain & HAS_RARE != 0
    }

    /// Whether codes of the node describe a subtree coarsely.
    #[inline(always)]
    pub(crate) const fn has_rough(&self) -> bool {
        self.gain & HAS_ROUGH != 0
    }

    /// The children that are on, and boxes that hold their lights.
    #[cfg(feature = "alloc")]
    pub(crate) fn lit_boxes(&self) -> impl Iterator<Item = (usize, Aabb)> {
        let code = 1.0 / self.inv_scale;
        let lit = (0..WIDTH).filter(|&k| self.power[k] > 0);
        lit.map(move |k| {
            let of = |codes: &[[u8; WIDTH]; 3]| {
                Vec3::from_array([0, 1, 2].map(|axis| f32::from(codes[axis][k]))) * code
            };
            let mean = Vec3::from(self.origin) + of(&self.mean);
            let half = of(&self.extent);
            (k, Aabb::new(mean - half, mean + half))
        })
    }

    /// How many children there are.
    #[inline]
    #[must_use]
    pub const fn children(&self) -> usize {
        (self.count & !ALONG_LINE) as usize
    }

    /// Whether the lights lie along a line, which a middle and a box describe badly from nearby.
    #[inline]
    pub(crate) const fn is_line(&self) -> bool {
        self.count & ALONG_LINE != 0
    }

    /// Sets whether the lights lie along a line.
    #[cfg(feature = "alloc")]
    pub(crate) const fn set_line(&mut self, is_line: bool) {
        let flag = if is_line { ALONG_LINE } else { 0 };
        self.count = (self.count & !ALONG_LINE) | flag;
    }

    /// The children that are nodes.
    #[inline]
    pub(crate) fn subtrees(&self) -> Range<usize> {
        0..usize::from(self.inner).min(WIDTH)
    }

    /// Whether all of its children are nodes, as in the upper levels of a large tree.
    #[inline]
    pub(crate) const fn has_subtrees_only(&self) -> bool {
        self.inner as usize == WIDTH
    }

    /// Whether a child is so small that codes of the node describe its place coarsely.
    #[inline]
    pub(crate) const fn is_small(&self, k: usize) -> bool {
        let [x, y, z] = &self.extent;
        let extent = x[k] | y[k] | z[k];
        // No extent is 0.
        extent == 1 || (extent <= SMALL_EXTENT && self.power[k] <= FAINT_POWER)
    }
}

/// The power that the bits of code 0 would mean without the subtraction.
const POWER_OF_CODE_0: f32 = f32::from_bits(96 << 23);

/// The power of a code: 0 for 0, otherwise a number of `[2^-34, 2)`.
#[inline(always)]
pub(crate) const fn decode_power(code: u8) -> f32 {
    f32::from_bits(((code as u32) << 20) + (96 << 23)) - POWER_OF_CODE_0
}

/// The code nearest to `power` of `[0, 1]`; never 0, which would make a light unreachable.
#[cfg(feature = "alloc")]
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "of 1, the code is 248")]
pub(crate) const fn encode_power(power: f32) -> u8 {
    // The code is the float's top bits, so rounding to nearest adds half of the last of them.
    let bits = (power + POWER_OF_CODE_0).to_bits() + (1 << 19);
    let code = (bits >> 20) - (96 << 3);
    if code == 0 { 1 } else { code as u8 }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;

    #[test]
    fn powers_decode_to_within_a_sixteenth() {
        let mut power = 1.0;
        while power > 1e-9 {
            let error = (decode_power(encode_power(power)) - power).abs();
            assert!(
                error <= (power + POWER_OF_CODE_0) / 16.0,
                "{power}: {error}"
            );
            power *= 0.97;
        }
    }

    #[test]
    fn a_1024th_is_faint() {
        assert_eq!(encode_power(1.0 / 1024.0), FAINT_POWER);
    }

    #[test]
    fn no_power_is_encoded_as_none() {
        for power in [0.0, 1e-30, f32::MIN_POSITIVE] {
            assert!(decode_power(encode_power(power)) > 0.0, "{power}");
        }
        assert_eq!(decode_power(0), 0.0, "an empty slot");
    }

    #[test]
    fn codes_come_back() {
        for code in 1..=248 {
            assert_eq!(encode_power(decode_power(code)), code, "code");
        }
    }
}
