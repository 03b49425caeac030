#![cfg_attr(
    all(feature = "std", target_arch = "x86_64"),
    expect(
        unsafe_code,
        reason = "functions compiled for vectors that not every machine has are unsafe to call"
    )
)]

//! The vector width, and the only `unsafe` code of the crate.
//!
//! Queries and the encoding of nodes run in the widest vectors that the machine has, detected at
//! run time where there is an operating system. The arithmetic and its order are the same in every
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

/// Prefetches the last cache line of each of `N` of `items`, of which one is read soon, from `first`
/// on. Their other lines would delay this one: most of them are not read.
#[inline(always)]
pub(crate) fn prefetch_ends<const N: usize, T>(items: &[T], first: u32) {
    let mut item = items.as_ptr().wrapping_add(first as usize);
    for _ in 0..N {
        let next = item.wrapping_add(1);
        prefetch_lines(next.cast::<u8>().wrapping_sub(1), 1);
        item = next;
    }
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

/// The results of `work` in every width that this machine has: the build's target first.
#[cfg(all(test, feature = "std", target_arch = "x86_64"))]
pub(crate) fn run_with_each_width<W: VectorWork + Copy>(work: W) -> alloc::vec::Vec<W::Output> {
    let mut results = alloc::vec![work.run()];
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has AVX2, the one feature that the function is compiled for.
        results.push(unsafe { run_with_avx2(work) });
    }
    #[cfg(avx512)]
    if has_avx512() {
        // SAFETY: `has_avx512` has found each feature that the function is compiled for.
        results.push(unsafe { run_with_avx512(work) });
    }
    results
}
