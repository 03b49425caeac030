use light_math::float::sqrt;
use light_math::quantize::{QuantizedBox, decode_cos, encode_cos};
use light_math::{Aabb, OctahedralVector};

use crate::{LightBounds, LightSampleContext};

/// Bits of a cosine's code.
const COS_BITS: u32 = 15;

/// One code of a cosine.
const COS_MASK: u32 = (1 << COS_BITS) - 1;

/// Position of the two-sided bit.
const TWO_SIDED_BIT: u32 = 2 * COS_BITS;

/// [`LightBounds`] in 24 bytes, relative to a box around all lights.
///
/// Decoding is conservative: the decoded box, cone of normals and angle of emission contain the
/// original's. Where the original has a positive importance, so has the compact form.
///
/// # Source
/// `[PBRT4]`, section 12.6.3. The codes are the same, but there the rounded axis can turn normals
/// out of the cone; here decoding widens the cone by [`OctahedralVector::MAX_ANGULAR_ERROR`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct CompactLightBounds {
    w: OctahedralVector,
    phi: f32,
    /// `cos_theta_o`, `cos_theta_e` and `two_sided`, from the lowest bit up: 15, 15 and 1 bit.
    packed: u32,
    bounds: QuantizedBox,
}

const _: () = assert!(size_of::<CompactLightBounds>() == 24, "24 bytes");

impl CompactLightBounds {
    /// The compact form of valid `bounds` that lie in the box `all`.
    #[must_use]
    pub fn encode(bounds: &LightBounds, all: &Aabb) -> Self {
        Self {
            w: OctahedralVector::encode(bounds.w),
            phi: bounds.phi,
            packed: u32::from(encode_cos(bounds.cos_theta_o))
                | u32::from(encode_cos(bounds.cos_theta_e)) << COS_BITS
                | u32::from(bounds.two_sided) << TWO_SIDED_BIT,
            bounds: QuantizedBox::encode(&bounds.bounds, all),
        }
    }

    /// The decoded bounds, given the same box `all` as in [`encode`](Self::encode).
    #[inline(always)]
    #[must_use]
    pub fn decode(&self, all: &Aabb) -> LightBounds {
        LightBounds {
            bounds: self.bounds.decode(all),
            w: self.w.decode(),
            phi: self.phi,
            cos_theta_o: widened(decode_cos(self.cos_code(0))),
            cos_theta_e: decode_cos(self.cos_code(COS_BITS)),
            two_sided: self.packed >> TWO_SIDED_BIT & 1 == 1,
        }
    }

    /// [Importance](LightBounds::importance) of the decoded bounds at `ctx`.
    #[inline(always)]
    #[must_use]
    pub fn importance(&self, all: &Aabb, ctx: &LightSampleContext) -> f32 {
        self.decode(all).importance(ctx)
    }

    /// Emitted power in W, or in another unit common to all lights.
    #[inline]
    #[must_use]
    pub const fn phi(&self) -> f32 {
        self.phi
    }

    /// The code of the axis.
    #[inline]
    #[must_use]
    pub const fn w(&self) -> OctahedralVector {
        self.w
    }

    /// The code of the box.
    #[inline]
    #[must_use]
    pub const fn bounds(&self) -> QuantizedBox {
        self.bounds
    }

    /// The codes of both cosines and the two-sided bit:
    /// `cos_theta_o | cos_theta_e << 15 | two_sided << 30`.
    #[inline]
    #[must_use]
    pub const fn packed(&self) -> u32 {
        self.packed
    }

    #[inline]
    const fn cos_code(&self, shift: u32) -> u16 {
        (self.packed >> shift & COS_MASK) as u16
    }
}

/// The cosine of `acos(cos_theta) + OctahedralVector::MAX_ANGULAR_ERROR`, or a little less; at
/// least -1.
#[inline]
fn widened(cos_theta: f32) -> f32 {
    // The angle is so small that its sine is itself and one minus its cosine half its square.
    let delta = OctahedralVector::MAX_ANGULAR_ERROR;
    let sin_theta = sqrt((1.0 - cos_theta) * (1.0 + cos_theta));
    let lost = delta * (sin_theta + 0.5 * delta * cos_theta);
    // One unit in the last place more than the difference rounds off.
    (cos_theta - lost - 0.5 * f32::EPSILON).max(-1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::Vec3;
    use proptest::prelude::*;

    fn unit(v: [f32; 3]) -> Vec3 {
        Vec3::from(v).try_normalize().unwrap_or(Vec3::Z)
    }

    fn angle(a: Vec3, b: Vec3) -> f64 {
        let [a, b] = [a, b].map(|v| v.to_array().map(f64::from));
        let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (la, lb) = (length(a), length(b));
        let chord: [f64; 3] = core::array::from_fn(|i| a[i] / la - b[i] / lb);
        2.0 * (0.5 * length(chord)).min(1.0).asin()
    }

    #[test]
    fn fields_are_where_a_shader_expects_them() {
        let all = Aabb::new(Vec3::ZERO, Vec3::ONE);
        let bounds = LightBounds {
            bounds: Aabb::from_point(Vec3::ONE),
            w: Vec3::Z,
            phi: 3.0,
            cos_theta_o: 1.0,
            cos_theta_e: decode_cos(12_345),
            two_sided: true,
        };
        let compact = CompactLightBounds::encode(&bounds, &all);
        let packed = 32_767 | 12_345 << 15 | 1 << 30;
        assert_eq!(compact.packed(), packed, "cosines and the flag");
        assert_eq!(compact.phi(), 3.0, "as it is");
        let decoded = compact.decode(&all);
        assert_eq!(decoded.bounds, bounds.bounds, "a corner is exact");
        assert_eq!(decoded.cos_theta_e, bounds.cos_theta_e, "so is a code");
        assert!(decoded.two_sided, "and the flag");
        let ctx = LightSampleContext::medium(Vec3::new(0.5, 0.2, -3.0));
        let importance = compact.importance(&all, &ctx);
        assert_eq!(
            importance,
            decoded.importance(&ctx),
            "of what it decodes to"
        );
        assert!(importance > 0.0 && importance != 1.0, "{importance}");
    }

    /// The margin covers any code of the axis, and is at most what an arc cosine near 1 loses by
    /// rounding.
    #[test]
    fn every_cosine_is_widened_a_little() {
        for code in 0..=light_math::quantize::MAX_COS {
            let cos_theta = decode_cos(code);
            let before = f64::from(cos_theta).acos();
            let added = f64::from(widened(cos_theta)).acos() - before;
            let enough =
                f64::from(OctahedralVector::MAX_ANGULAR_ERROR).min(core::f64::consts::PI - before);
            assert!(added >= enough && added < 3.5e-4, "code {code}: {added}");
        }
    }

    proptest! {
        /// The decoded box, cone and emission contain the original's; checked in double precision.
        #[test]
        fn decoded_bounds_contain_the_original(
            w in prop::array::uniform3(-1.0f32..1.0),
            cosines in prop::array::uniform2(prop_oneof![
                -1.0f32..=1.0, Just(1.0), Just(-1.0), (0u16..32768).prop_map(decode_cos),
            ]),
            corners in prop::array::uniform6(prop_oneof![-1e3f32..1e3, -1e20f32..1e20, Just(0.0)]),
            two_sided in any::<bool>(),
        ) {
            let [a, b, c, d, e, f] = corners;
            let [cos_theta_o, cos_theta_e] = cosines;
            let bounds = LightBounds {
                bounds: Aabb::new(Vec3::new(a, b, c), Vec3::new(d, e, f)),
                w: unit(w),
                phi: 1.0,
                cos_theta_o,
                cos_theta_e,
                two_sided,
            };
            let all = bounds.bounds.extend(Vec3::ZERO);
            let decoded = CompactLightBounds::encode(&bounds, &all).decode(&all);

            prop_assert!(decoded.bounds.contains_box(&bounds.bounds));
            prop_assert!(decoded.cos_theta_e <= cos_theta_e && decoded.two_sided == two_sided);
            let theta = f64::from(cos_theta_o).acos();
            let far_side = theta + angle(bounds.w, decoded.w);
            let decoded_theta = f64::from(decoded.cos_theta_o).acos();
            prop_assert!(
                decoded.cos_theta_o == -1.0 || decoded_theta >= far_side,
                "{} of {}", decoded_theta, far_side
            );
        }
    }
}
