use crate::lane_math::{larger, low_byte, nearest, reduce, smaller};
use crate::node::children_soa::ChildrenSoa;
use crate::node::moments::Moments;
use crate::node::wide_node::{WIDTH, WideNode, encode_power};
use crate::simd::{VectorWork, dispatch};

/// The least scale of a node: lights closer together than this are taken as one point.
const MIN_SCALE: f32 = 1e-30;

impl WideNode {
    /// A node whose children have the given moments, no more than it has slots; `child_base`,
    /// `light_base`, `inner` and `parent` are left to the caller.
    #[cfg(test)]
    pub(crate) fn encode(children: &[Moments]) -> Self {
        let mut node = Self::EMPTY;
        node.encode_children(children);
        node
    }

    /// Encodes the moments of the children, at most as many as the node has slots. Their places,
    /// and how many are nodes, do not change.
    pub(crate) fn encode_children(&mut self, children: &[Moments]) {
        dispatch(EncodeChildren {
            node: self,
            children,
        });
    }

    #[inline(always)]
    fn set(&mut self, children: &[Moments]) {
        debug_assert!(
            children.len() <= WIDTH,
            "no more children than a node has slots"
        );
        self.count = u8::try_from(children.len()).unwrap_or(0);
        let Some(some) = children.iter().find(|c| c.power > 0.0) else {
            *self = Self {
                count: self.count,
                child_base: self.child_base,
                light_base: self.light_base,
                inner: self.inner,
                parent: self.parent,
                ..Self::EMPTY
            };
            return;
        };
        let children = ChildrenSoa::new(children, some);
        self.set_frame(&children);
        self.set_boxes(&children);
        let units = self.set_emission(&children);
        self.set_power(&children, &units);
        self.clear_unlit(&children);
    }

    #[inline(always)]
    fn set_frame(&mut self, children: &ChildrenSoa) {
        let mut scale = MIN_SCALE;
        for axis in 0..3 {
            let (low, mean, high) = (
                &children.low[axis],
                &children.mean[axis],
                &children.high[axis],
            );
            let origin = reduce(*mean, smaller);
            let mut needed = [0.0; WIDTH];
            for k in 0..WIDTH {
                let half = larger(high[k] - mean[k], mean[k] - low[k]);
                needed[k] = larger((mean[k] - origin) * (1.0 / 255.0), half * (1.0 / 253.0));
            }
            scale = larger(scale, reduce(needed, larger));
            self.origin[axis] = origin;
        }
        // A little more, so that rounding cannot push a code beyond its range.
        self.inv_scale = (1.0 - 4.0 * f32::EPSILON) / scale;
    }

    /// Mean positions, and boxes around them that hold what they must.
    ///
    /// A difference of two floats is off by half an epsilon of itself, however far from zero they
    /// are. Twice 255 codes are so known to within 1e-4 of a code, and a receiver rounds a
    /// position by 2e-4 and a share of its distance: the margin outweighs both.
    #[inline(always)]
    fn set_boxes(&mut self, children: &ChildrenSoa) {
        const MARGIN: f32 = 0.001;
        let inv_scale = self.inv_scale;
        for axis in 0..3 {
            let origin = self.origin[axis];
            for k in 0..WIDTH {
                let codes = |x: f32| (x - origin) * inv_scale;
                let mean = nearest(codes(children.mean[axis][k]));
                let above = codes(children.high[axis][k]) - mean;
                let below = mean - codes(children.low[axis][k]);
                self.mean[axis][k] = low_byte(mean);
                // Rounded up, and never to 0: a child without extent keeps a floor of uncertainty.
                self.extent[axis][k] = low_byte(nearest(larger(above, below) + (0.5 + MARGIN)));
            }
        }
    }

    #[inline(always)]
    fn set_power(&mut self, children: &ChildrenSoa, units: &[f32; WIDTH]) {
        let mut powers = [0.0; WIDTH];
        for k in 0..WIDTH {
            let sides = if children.both_sides[k] { 2.0 } else { 1.0 };
            powers[k] = sides * children.power[k] * units[k];
        }
        let max_power = larger(reduce(powers, larger), f32::MIN_POSITIVE);
        self.gain = encode_gain(max_power);
        self.power = powers.map(|power| encode_power(power / max_power));
    }

    /// What is off leaves its slot empty.
    #[inline(always)]
    fn clear_unlit(&mut self, children: &ChildrenSoa) {
        let lit = children.power.map(|power| power > 0.0);
        if lit == [true; WIDTH] {
            return;
        }
        let keep = lit.map(|lit| if lit { 0xff } else { 0 });
        let codes = self
            .mean
            .iter_mut()
            .chain([&mut self.spread, &mut self.power]);
        for codes in codes {
            for k in 0..WIDTH {
                codes[k] &= keep[k];
            }
        }
        for codes in &mut self.extent {
            for k in 0..WIDTH {
                codes[k] = if lit[k] { codes[k] } else { 1 };
            }
        }
        for codes in self.axis.iter_mut().chain([&mut self.offset]) {
            for k in 0..WIDTH {
                codes[k] &= keep[k] as i8;
            }
        }
    }
}

/// A node and the children that it encodes.
struct EncodeChildren<'a> {
    node: &'a mut WideNode,
    children: &'a [Moments],
}

impl VectorWork for EncodeChildren<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.node.set(self.children);
    }
}

/// The upper half of the float, finite and above 0.
fn encode_gain(power: f32) -> u16 {
    ((power.clamp(f32::MIN_POSITIVE, 1e30).to_bits() + 0x8000) >> 16) as u16
}

#[cfg(test)]
mod tests {
    use super::*;
    use light_math::Aabb;
    use light_math::glam::Vec3;

    /// Numbers of `[-1, 1)`.
    fn numbers() -> impl FnMut() -> f32 {
        let mut state = 1u32;
        move || {
            state = state.wrapping_mul(0x915f_77f5).wrapping_add(1);
            (state >> 8) as f32 / (1 << 23) as f32 - 1.0
        }
    }

    fn vector(next: &mut impl FnMut() -> f32) -> Vec3 {
        Vec3::new(next(), next(), next())
    }

    /// Children about `at`, with boxes and axes of any size.
    fn children(next: &mut impl FnMut() -> f32, at: Vec3, size: f32) -> [Moments; WIDTH] {
        core::array::from_fn(|_| {
            let (a, b) = (at + vector(next) * size, at + vector(next) * size);
            let bounds = Aabb::new(a.min(b), a.max(b));
            Moments {
                power: 1.0,
                bounds,
                mean: (a + (b - a) * next().abs()).clamp(bounds.min, bounds.max),
                axis: vector(next) * 4.0 * next(),
                offset: next(),
                ..Moments::NOTHING
            }
        })
    }

    #[test]
    fn boxes_hold_what_they_must() {
        let mut next = numbers();
        for (at, size) in [
            (0.0, 1.0),
            (1e4, 0.01),
            (-1e3, 1e3),
            (0.0, 1e-20),
            (1e30, 1e36),
        ] {
            for _ in 0..2000 {
                let children = children(&mut next, Vec3::splat(at), size);
                let node = WideNode::encode(&children);
                for (k, child) in children.iter().enumerate() {
                    for axis in 0..3 {
                        let code = |code: u8| f64::from(code) / f64::from(node.inv_scale);
                        let mean = f64::from(node.origin[axis]) + code(node.mean[axis][k]);
                        let half = code(node.extent[axis][k]);
                        let (min, max) = (child.bounds.min[axis], child.bounds.max[axis]);
                        assert!(mean - half <= f64::from(min), "{k}: {child:?} in {node:?}");
                        assert!(mean + half >= f64::from(max), "{k}: {child:?} in {node:?}");
                    }
                }
            }
        }
    }

    /// In all directions in which the exact line emits, and from its codes: a margin is left for the
    /// rounding of receivers.
    #[test]
    fn offsets_leave_what_receivers_round_off() {
        /// In codes; nine tenths of the margin, the rest is the encoder's own round-off.
        const LEFT: f64 = 0.009;
        let mut next = numbers();
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (mut sharp, mut least_left) = (0, f64::INFINITY);
        for _ in 0..20_000 {
            let children = children(&mut next, Vec3::ZERO, 1.0);
            let node = WideNode::encode(&children);
            for (k, child) in children.iter().enumerate() {
                let decoded = node.axis.map(|axis| f64::from(axis[k]));
                let axis = child.axis.to_array().map(f64::from);
                let length = dot(axis, axis).sqrt();
                let cos = f64::from(child.offset) / length;
                if node.spread[k] > 0 || !(cos.abs() < 1.0) {
                    continue;
                }
                let along = dot(decoded, axis) / length;
                let aside = (dot(decoded, decoded) - along * along).max(0.0).sqrt();
                let sin = (1.0 - cos * cos).sqrt();
                // Seen from the exact axis, the direction opposite to the decoded one is at the
                // angle of cosine `-along / |decoded|`.
                let opposite_is_lit = -along / dot(decoded, decoded).sqrt() >= cos;
                let least = if opposite_is_lit {
                    -dot(decoded, decoded).sqrt()
                } else {
                    along * cos - aside * sin
                };
                sharp += 1;
                least_left = least_left.min(least - f64::from(node.offset[k]));
            }
        }
        assert!(sharp > 20_000, "{sharp} sharp");
        assert!(least_left >= LEFT, "{least_left} codes are left");
    }

    #[test]
    fn nothing_sharp_shines_beyond_its_axis_and_offset() {
        let mut next = numbers();
        let (mut sharp, mut lit) = (0, 0);
        for _ in 0..1000 {
            let children = children(&mut next, Vec3::ZERO, 1.0);
            let node = WideNode::encode(&children);
            let w = vector(&mut next).normalize_or(Vec3::X);
            for (k, child) in children.iter().enumerate() {
                let axis = Vec3::from(node.axis.map(|axis| f32::from(axis[k])));
                sharp += u32::from(node.spread[k] == 0);
                if node.spread[k] == 0 && child.axis.dot(w) > child.offset {
                    lit += 1;
                    let decoded = axis.dot(w) - f32::from(node.offset[k]);
                    assert!(decoded > 0.0, "{k}: {child:?} in {node:?}");
                }
            }
        }
        assert!(sharp > 1000 && lit > 1000, "{sharp} sharp, {lit} lit");
    }

    #[test]
    fn wide_vectors_encode_as_narrow_ones_do() {
        let mut next = numbers();
        for _ in 0..300 {
            let mut children = children(&mut next, Vec3::splat(3.0), 2.0);
            for child in &mut children {
                child.power = next().max(0.0);
                child.spread_sq = next().max(0.0);
            }
            let mut narrow = WideNode::EMPTY;
            narrow.set(&children);
            assert_eq!(WideNode::encode(&children), narrow, "{children:?}");
        }
    }

    #[test]
    fn what_is_off_leaves_its_slot_empty() {
        let mut children = children(&mut numbers(), Vec3::ZERO, 1.0);
        children[3] = Moments::NOTHING;
        let node = WideNode::encode(&children[..7]);
        assert_eq!(node.count, 7, "with the empty slot");
        for k in [3, 7] {
            assert_eq!(node.power[k], 0, "slot {k}");
            assert_eq!(node.extent.map(|extent| extent[k]), [1; 3], "slot {k}");
        }
        assert!(node.power[..3].iter().all(|&power| power > 0), "others");
    }
}
