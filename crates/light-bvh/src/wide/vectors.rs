#![cfg_attr(
    all(feature = "std", target_arch = "x86_64"),
    expect(
        unsafe_code,
        reason = "code for instructions that not every machine has can only be called so"
    )
)]

//! Which vectors a node's lanes are computed in: the widest that the machine has, asked at run time where there is an operating system.
//!
//! The same arithmetic in the same order either way, nothing fused: the same bits.

use super::importance::Receiver;
use super::lane::Weights;
use super::node::{WIDTH, WideNode};

impl Weights {
    /// What the children of `node` are worth to `receiver`.
    #[inline(always)]
    pub(crate) fn new<R: Receiver>(node: &WideNode, receiver: &R) -> Self {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the machine has AVX2.
            return unsafe { avx2::weights(node, receiver) };
        }
        Self::narrow(node, receiver)
    }

    /// The same, and for each child how rough its estimate is: 0 for a point far away, 1 for a box around the receiver.
    #[inline(always)]
    pub(crate) fn with_roughness<R: Receiver>(
        node: &WideNode,
        receiver: &R,
    ) -> (Self, [f32; WIDTH]) {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        if std::arch::is_x86_feature_detected!("avx2") {
            // SAFETY: the machine has AVX2.
            return unsafe { avx2::weights_with_roughness(node, receiver) };
        }
        Self::narrow_with_roughness(node, receiver)
    }
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod avx2 {
    use super::*;

    /// # Safety
    /// The machine has to have AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn weights<R: Receiver>(node: &WideNode, receiver: &R) -> Weights {
        Weights::narrow(node, receiver)
    }

    /// # Safety
    /// The machine has to have AVX2.
    #[target_feature(enable = "avx2")]
    pub(super) unsafe fn weights_with_roughness<R: Receiver>(
        node: &WideNode,
        receiver: &R,
    ) -> (Weights, [f32; WIDTH]) {
        Weights::narrow_with_roughness(node, receiver)
    }
}

#[cfg(all(test, feature = "std", target_arch = "x86_64"))]
mod tests {
    use light_math::glam::Vec3;

    use super::*;
    use crate::wide::glossy::GlossyReceiver;
    use crate::wide::importance::{MediumReceiver, SurfaceReceiver, TwoSidedReceiver};
    use crate::wide::segment::SegmentReceiver;

    fn bits(weights: &Weights) -> [u32; WIDTH] {
        weights.lanes.map(f32::to_bits)
    }

    /// Trivially true where the machine has no wider vectors than the build's target.
    #[test]
    fn wide_vectors_give_the_bits_of_narrow_ones() {
        fn check<R: Receiver>(node: &WideNode, receiver: &R) {
            let (narrow, wide) = (
                Weights::narrow(node, receiver),
                Weights::new(node, receiver),
            );
            assert_eq!(bits(&narrow), bits(&wide), "weights of {node:?}");
            let narrow = Weights::narrow_with_roughness(node, receiver);
            let wide = Weights::with_roughness(node, receiver);
            assert_eq!(bits(&narrow.0), bits(&wide.0), "weights of {node:?}");
            let roughness = |r: [f32; WIDTH]| r.map(f32::to_bits);
            assert_eq!(roughness(narrow.1), roughness(wide.1), "of {node:?}");
        }
        let mut state = 1u32;
        let mut next = || {
            state = state.wrapping_mul(0x915f_77f5).wrapping_add(1);
            (state >> 16).to_le_bytes()[0]
        };
        for _ in 0..500 {
            let mut bytes = || core::array::from_fn::<u8, WIDTH, _>(|_| next());
            let node = WideNode {
                mean: [bytes(), bytes(), bytes()],
                extent: [bytes(), bytes(), bytes()],
                axis: [bytes(), bytes(), bytes()]
                    .map(|axis| axis.map(|code| i8::from_ne_bytes([code]))),
                offset: bytes().map(|code| i8::from_ne_bytes([code])),
                spread: bytes().map(|x| x / 2),
                power: bytes(),
                scale: 0.01,
                ..WideNode::EMPTY
            };
            let [x, y, z, ..] = bytes().map(|x| f32::from(x) * 0.01);
            let (p, n) = (Vec3::new(x, y, z), Vec3::new(y, z, 0.1 - x).normalize());
            let gloss = light_bounds::Gloss {
                wo: n,
                alpha: 0.2,
                diffuse: 0.5,
            };
            check(&node, &SurfaceReceiver::new(p, n));
            check(&node, &GlossyReceiver::new(p, n, &gloss));
            check(&node, &TwoSidedReceiver::new(p, n));
            check(&node, &MediumReceiver::new(p));
            check(&node, &SegmentReceiver::new(p, n));
        }
    }
}
