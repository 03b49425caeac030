use crate::lane_math::{larger, low_byte, nearest, reduce, smaller};
use crate::node::children_soa::ChildrenSoa;
use crate::node::moments::Moments;
use crate::node::wide_node::{HAS_RARE, HAS_ROUGH, WIDTH, WideNode, encode_power};
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

    /// Encodes the moments of the children, at most as many as the node has slots, and returns those
    /// of all together. Their places, and how many are nodes, do not change.
    pub(crate) fn encode_children(&mut self, children: &[Moments]) -> Moments {
        dispatch(EncodeChildren {
            node: self,
            children,
        });
        let all = Moments::join(children);
        self.set_line(all.is_line());
        all
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
        let all = children;
        let children = ChildrenSoa::new(all, some);
        self.set_frame(&children);
        self.set_boxes(&children);
        let units = self.set_emission(&children);
        self.set_power(&children, &units);
        self.clear_unlit(&children);
        self.set_sheets(all);
        self.set_opposed(all);
        let subtrees = &all[..self.subtrees().end.min(all.len())];
        if self.subtrees().any(|k| self.is_rough(k))
            || subtrees.iter().any(Moments::is_line)
            || self.is_large(all)
        {
            self.gain |= HAS_ROUGH;
        }
    }

    /// Whether codes of the node describe a child that is a node coarsely.
    fn is_rough(&self, k: usize) -> bool {
        self.is_small(k) || self.is_step(k)
    }

    /// Whether a child of many lights is a node, and the lights of all children face about the same
    /// way.
    fn is_large(&self, children: &[Moments]) -> bool {
        let mut subtrees = children.iter().take(self.subtrees().end);
        subtrees.any(Moments::is_large) && Moments::face_alike(children)
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

    /// Where flat lights lie in a thin slanted sheet, the offset, which is 0, tells how it lies.
    fn set_sheets(&mut self, children: &[Moments]) {
        for (offset, child) in self.offset.iter_mut().zip(children) {
            if *offset != 0 || !(child.power > 0.0) {
                continue;
            }
            if let Some(sheet) = child.sheet() {
                *offset = sheet.0;
                self.gain |= HAS_RARE;
            }
        }
    }

    /// Where beams go both ways along a line, the offset is odd; of all other groups of steps of such a
    /// node it is even.
    fn set_opposed(&mut self, children: &[Moments]) {
        if children.iter().any(Moments::is_opposed) {
            self.gain |= HAS_RARE;
        }
        if !self.has_rare() {
            return;
        }
        for (k, child) in children.iter().enumerate() {
            if self.is_step_group(k) {
                let even = self.offset[k] - self.offset[k] % 2;
                self.offset[k] = even + i8::from(child.is_opposed());
            }
        }
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

/// The upper half of the float, above 0 and at most 1.
fn encode_gain(power: f32) -> u16 {
    ((power.clamp(f32::MIN_POSITIVE, 1.0).to_bits() + 0x8000) >> 16) as u16
}

#[cfg(test)]
mod tests;
