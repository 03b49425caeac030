#![cfg_attr(
    all(feature = "std", target_arch = "x86_64"),
    expect(
        unsafe_code,
        reason = "functions compiled for vectors that not every machine has are unsafe to call"
    )
)]

//! The vector width, and the only `unsafe` code of the crate.
//!
//! Queries and the encoding of nodes run in the widest vectors that the machine has, asked at run
//! time where there is an operating system. The arithmetic and its order are the same in every
//! width, and nothing is fused: the same bits.

/// Bytes that memory delivers at once.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
const CACHE_LINE: usize = 64;

/// A computation that is compiled once for each vector width.
pub(crate) trait VectorWork {
    type Output;

    /// Runs it. Every implementation is `#[inline(always)]`: its caller chooses the vectors.
    fn run(self) -> Self::Output;
}

/// Runs `work` in the widest vectors that the machine has.
///
/// The whole work is one function for each width, so that what a receiver knows stays in registers
/// on its way down a tree.
#[inline(always)]
pub(crate) fn dispatch<W: VectorWork>(work: W) -> W::Output {
    #[cfg(avx512)]
    if has_avx512() {
        // SAFETY: `has_avx512` has found each feature that the function is compiled for.
        return unsafe { run_with_avx512(work) };
    }
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, the one feature that the function is compiled for.
        return unsafe { run_with_avx2(work) };
    }
    work.run()
}

/// # Safety
/// The processor has AVX2.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2")]
unsafe fn run_with_avx2<W: VectorWork>(work: W) -> W::Output {
    work.run()
}

/// Whether the processor has AVX-512, of the generation from which on it costs no clock frequency.
#[cfg(avx512)]
#[inline(always)]
fn has_avx512() -> bool {
    use std::arch::is_x86_feature_detected as has;
    has!("avx512vbmi2") && has!("avx512vl") && has!("avx512dq")
}

/// # Safety
/// The processor [has AVX-512](has_avx512).
#[cfg(avx512)]
#[target_feature(enable = "avx512vbmi2,avx512vl,avx512dq")]
unsafe fn run_with_avx512<W: VectorWork>(work: W) -> W::Output {
    work.run()
}

/// Prefetches `item`, which is read soon: a light that was chosen, while other work is done. Does
/// nothing on machines without such an instruction.
#[inline(always)]
pub fn prefetch_item<T>(item: &T) {
    prefetch_lines(item, 1);
}

/// Prefetches `N` of `items`, which are read soon, from `first` on.
#[inline(always)]
pub(crate) fn prefetch<const N: usize, T>(items: &[T], first: u32) {
    prefetch_lines(items.as_ptr().wrapping_add(first as usize), N);
}

/// Prefetches every cache line that `count` items are on.
#[inline(always)]
fn prefetch_lines<T>(from: *const T, count: usize) {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let (mut byte, last) = (0, (count * size_of::<T>()).saturating_sub(1));
        loop {
            let line = from.cast::<i8>().wrapping_add(byte);
            // SAFETY: every x86-64 processor has SSE, and a prefetch of any address is allowed: it
            // never faults.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(line) };
            if byte == last {
                break;
            }
            byte = (byte + CACHE_LINE).min(last);
        }
    }
    #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
    let _ = (from, count);
}

#[cfg(all(test, feature = "std", target_arch = "x86_64"))]
mod tests {
    use light_math::glam::Vec3;

    use super::*;
    use crate::importance::glossy::GlossyReceiver;
    use crate::importance::medium::MediumReceiver;
    use crate::importance::receiver::Receiver;
    use crate::importance::segment::SegmentReceiver;
    use crate::importance::surface::SurfaceReceiver;
    use crate::importance::two_sided::TwoSidedReceiver;
    use crate::node::wide_node::{WIDTH, WideNode};
    use crate::query::into_receiver::{Query, QueryFor};
    use crate::query::weights::Weights;

    /// The weights of a node's children and their angular_size_sq, as bits.
    struct Bits<'a>(&'a WideNode);

    impl Query for Bits<'_> {
        type Output = [[u32; WIDTH]; 2];

        #[inline(always)]
        fn run<R: Receiver>(self, receiver: &R) -> Self::Output {
            let (weights, angular_size_sq) = Weights::with_angular_size(self.0, receiver);
            [weights.lanes, angular_size_sq].map(|lanes| lanes.map(f32::to_bits))
        }
    }

    /// Trivially true where the machine has no wider vectors than the build's target.
    #[test]
    fn wide_vectors_give_the_bits_of_narrow_ones() {
        fn check<R: Receiver>(node: &WideNode, receiver: &R) {
            let narrow = Bits(node).run(receiver);
            let widest = dispatch(QueryFor(receiver, Bits(node)));
            assert_eq!(narrow, widest, "weights of {node:?}");
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: the machine has AVX2.
                let wide = unsafe { run_with_avx2(QueryFor(receiver, Bits(node))) };
                assert_eq!(narrow, wide, "by AVX2, weights of {node:?}");
            }
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
                inv_scale: 100.0,
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
