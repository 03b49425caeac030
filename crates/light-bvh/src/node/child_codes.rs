use crate::node::wide_node::{WIDTH, WideNode};

/// Whether the codes of four children are loaded at once. A GPU does not compute children side by
/// side, and each of its loads costs the same, of a byte or a word.
pub(crate) const READS_WORDS: bool = cfg!(target_arch = "nvptx64");

/// The codes of one child of a [`WideNode`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChildCodes {
    pub(crate) mean: [u8; 3],
    pub(crate) extent: [u8; 3],
    pub(crate) axis: [i8; 3],
    pub(crate) offset: i8,
    pub(crate) spread: u8,
    pub(crate) power: u8,
}

/// The codes of four children side by side: a word of each row of the node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FourChildren {
    mean: [u32; 3],
    extent: [u32; 3],
    axis: [u32; 3],
    offset: u32,
    spread: u32,
    power: u32,
}

impl WideNode {
    /// The codes of child `k`.
    #[inline(always)]
    pub(crate) const fn child_codes(&self, k: usize) -> ChildCodes {
        ChildCodes {
            mean: [self.mean[0][k], self.mean[1][k], self.mean[2][k]],
            extent: [self.extent[0][k], self.extent[1][k], self.extent[2][k]],
            axis: [self.axis[0][k], self.axis[1][k], self.axis[2][k]],
            offset: self.offset[k],
            spread: self.spread[k],
            power: self.power[k],
        }
    }

    /// The children from `4 * quarter` on, in twelve loads of a word.
    #[inline(always)]
    pub(crate) const fn four_children(&self, quarter: usize) -> FourChildren {
        let k = 4 * (quarter & 3);
        let [m0, m1, m2] = &self.mean;
        let [e0, e1, e2] = &self.extent;
        let [a0, a1, a2] = &self.axis;
        FourChildren {
            mean: [word(m0, k), word(m1, k), word(m2, k)],
            extent: [word(e0, k), word(e1, k), word(e2, k)],
            axis: [signed_word(a0, k), signed_word(a1, k), signed_word(a2, k)],
            offset: signed_word(&self.offset, k),
            spread: word(&self.spread, k),
            power: word(&self.power, k),
        }
    }
}

impl FourChildren {
    /// The codes of one of them.
    #[inline(always)]
    pub(crate) const fn child_codes(&self, k: usize) -> ChildCodes {
        let Self {
            mean, extent, axis, ..
        } = self;
        ChildCodes {
            mean: [byte(mean[0], k), byte(mean[1], k), byte(mean[2], k)],
            extent: [byte(extent[0], k), byte(extent[1], k), byte(extent[2], k)],
            axis: [
                byte(axis[0], k) as i8,
                byte(axis[1], k) as i8,
                byte(axis[2], k) as i8,
            ],
            offset: byte(self.offset, k) as i8,
            spread: byte(self.spread, k),
            power: byte(self.power, k),
        }
    }
}

#[inline(always)]
const fn word(row: &[u8; WIDTH], k: usize) -> u32 {
    u32::from_le_bytes([row[k], row[k + 1], row[k + 2], row[k + 3]])
}

#[inline(always)]
#[expect(clippy::cast_sign_loss, reason = "the same bits")]
const fn signed_word(row: &[i8; WIDTH], k: usize) -> u32 {
    let [a, b, c, d] = [row[k], row[k + 1], row[k + 2], row[k + 3]];
    u32::from_le_bytes([a as u8, b as u8, c as u8, d as u8])
}

#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the low byte")]
const fn byte(word: u32, k: usize) -> u8 {
    (word >> (8 * k)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_at_once_are_the_same() {
        let mut node = WideNode::EMPTY;
        let mut code = 0u8;
        let mut next = || {
            code = code.wrapping_mul(5).wrapping_add(89);
            code
        };
        for k in 0..WIDTH {
            for axis in 0..3 {
                node.mean[axis][k] = next();
                node.extent[axis][k] = next();
                node.axis[axis][k] = next() as i8;
            }
            node.offset[k] = next() as i8;
            node.spread[k] = next();
            node.power[k] = next();
        }
        for k in 0..WIDTH {
            let four = node.four_children(k / 4);
            assert_eq!(four.child_codes(k % 4), node.child_codes(k), "{k}");
        }
    }
}
