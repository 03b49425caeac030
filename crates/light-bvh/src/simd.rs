#![cfg_attr(
    all(feature = "std", target_arch = "x86_64"),
    expect(
        unsafe_code,
        reason = "code for instructions that not every machine has can only be called so"
    )
)]

//! Which vectors a query is answered in, or a node made in: the widest that the machine has, asked at run time where there is an operating system.
//!
//! The same arithmetic in the same order either way, nothing fused: the same bits.

use crate::query::into_receiver::{Asker, Query};

/// Bytes that the memory delivers at once.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
const CACHE_LINE: usize = 64;

/// The answer to `query`, as the receiver that `asker` turns into sees the tree.
///
/// The whole query is one piece of code for each kind of vector, so that what a receiver knows stays in registers on its way down.
#[inline(always)]
pub(crate) fn answer<A: Asker, Q: Query>(asker: A, query: Q) -> Q::Answer {
    #[cfg(avx512)]
    if has_avx512() {
        // SAFETY: as it says.
        return unsafe { answer_by_avx512(asker, query) };
    }
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the machine has AVX2.
        return unsafe { answer_by_avx2(asker, query) };
    }
    asker.ask(query)
}

/// # Safety
/// The machine has to have AVX2.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2")]
unsafe fn answer_by_avx2<A: Asker, Q: Query>(asker: A, query: Q) -> Q::Answer {
    asker.ask(query)
}

/// Whether the machine has AVX-512, of the generation from which on it costs no clock frequency.
#[cfg(avx512)]
#[inline(always)]
fn has_avx512() -> bool {
    use std::arch::is_x86_feature_detected as has;
    has!("avx512vbmi2") && has!("avx512vl") && has!("avx512dq")
}

/// # Safety
/// The machine [has AVX-512](has_avx512).
#[cfg(avx512)]
#[target_feature(enable = "avx512vbmi2,avx512vl,avx512dq")]
unsafe fn answer_by_avx512<A: Asker, Q: Query>(asker: A, query: Q) -> Q::Answer {
    asker.ask(query)
}

/// Arithmetic to be done in the widest vectors.
#[cfg(feature = "alloc")]
pub(crate) trait Work {
    type Output;

    /// Does it. To be inlined where it is called: there the vectors are chosen.
    fn run(self) -> Self::Output;
}

/// What `work` makes, in the widest vectors that the machine has.
#[cfg(feature = "alloc")]
#[inline(always)]
pub(crate) fn widely<W: Work>(work: W) -> W::Output {
    #[cfg(avx512)]
    if has_avx512() {
        // SAFETY: as it says.
        return unsafe { run_by_avx512(work) };
    }
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the machine has AVX2.
        return unsafe { run_by_avx2(work) };
    }
    work.run()
}

/// # Safety
/// The machine has to have AVX2.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[target_feature(enable = "avx2")]
unsafe fn run_by_avx2<W: Work>(work: W) -> W::Output {
    work.run()
}

/// # Safety
/// The machine [has AVX-512](has_avx512).
#[cfg(all(avx512, feature = "alloc"))]
#[target_feature(enable = "avx512vbmi2,avx512vl,avx512dq")]
unsafe fn run_by_avx512<W: Work>(work: W) -> W::Output {
    work.run()
}

/// Asks the memory for `item`, which is read soon: a light that was chosen, while other work is done. On machines where that cannot be asked
/// nothing happens.
#[inline(always)]
pub fn prefetch_item<T>(item: &T) {
    ask_memory(item, 1);
}

/// Asks the memory for `N` of `items`, which are read soon.
#[inline(always)]
pub(crate) fn prefetch<const N: usize, T>(items: &[T], first: u32) {
    ask_memory(items.as_ptr().wrapping_add(first as usize), N);
}

/// Asks the memory for every cache line that `count` items are on.
#[inline(always)]
fn ask_memory<T>(from: *const T, count: usize) {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let (mut byte, last) = (0, (count * size_of::<T>()).saturating_sub(1));
        loop {
            let line = from.cast::<i8>().wrapping_add(byte);
            // SAFETY: every machine of this kind has the instruction, and it may be given any address.
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
    use crate::importance::segment::SegmentReceiver;
    use crate::importance::surface::{MediumReceiver, Receiver, SurfaceReceiver, TwoSidedReceiver};
    use crate::node::wide_node::{WIDTH, WideNode};
    use crate::query::into_receiver::Oneself;
    use crate::query::weights::Weights;

    /// The weights of a node's children and their roughness, as bits.
    struct Bits<'a>(&'a WideNode);

    impl Query for Bits<'_> {
        type Answer = [[u32; WIDTH]; 2];

        #[inline(always)]
        fn of<R: Receiver>(self, receiver: &R) -> Self::Answer {
            let (weights, roughness) = Weights::with_roughness(self.0, receiver);
            [weights.lanes, roughness].map(|lanes| lanes.map(f32::to_bits))
        }
    }

    /// Trivially true where the machine has no wider vectors than the build's target.
    #[test]
    fn wide_vectors_give_the_bits_of_narrow_ones() {
        fn check<R: Receiver>(node: &WideNode, receiver: &R) {
            let narrow = Bits(node).of(receiver);
            let widest = answer(Oneself(receiver), Bits(node));
            assert_eq!(narrow, widest, "weights of {node:?}");
            if std::arch::is_x86_feature_detected!("avx2") {
                // SAFETY: the machine has AVX2.
                let wide = unsafe { answer_by_avx2(Oneself(receiver), Bits(node)) };
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
