//! The core's queries as kernels, one thread a query. `cargo xtask ptx` makes `kernels.ptx` of
//! them.
//!
//! A kernel takes the arrays of a tree as pointers and counts, then queries, answers and their
//! number. Threads beyond that number do nothing.

#![no_std]
#![feature(abi_ptx, stdarch_nvptx)]

use core::arch::nvptx;
use core::panic::PanicInfo;
use core::slice::from_raw_parts;

use light_bvh::{LightBvhRef, WideNode};
use light_ptx_queries::{
    Arrived, Choices, Chosen, LightRecord, Query, arrive, decode, pmf, sample, sample_by_cut,
};

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: it ends the grid.
    unsafe { nvptx::trap() }
}

/// The number of this thread in the grid.
#[inline(always)]
fn thread() -> u64 {
    // SAFETY: reads registers.
    unsafe {
        let block = u64::from(nvptx::_block_idx_x()) * u64::from(nvptx::_block_dim_x());
        block + u64::from(nvptx::_thread_idx_x())
    }
}

/// The arrays of a tree.
///
/// # Safety
/// The pointers lead to so many elements, which nobody writes.
#[inline(always)]
unsafe fn tree<'a>(
    nodes: *const WideNode,
    node_count: u64,
    order: *const u32,
    order_count: u64,
    slots: *const u32,
    slot_count: u64,
) -> LightBvhRef<'a> {
    // SAFETY: as promised by the caller.
    unsafe {
        LightBvhRef::new(
            from_raw_parts(nodes, node_count as usize),
            from_raw_parts(order, order_count as usize),
            from_raw_parts(slots, slot_count as usize),
        )
    }
}

/// A kernel that asks a tree.
macro_rules! of_a_tree {
    ($(#[$doc:meta])* $name:ident: $query:ident -> $answer:ty) => {
        $(#[$doc])*
        ///
        /// # Safety
        /// The pointers lead to so many elements; nobody else writes the answers.
        #[unsafe(no_mangle)]
        pub unsafe extern "ptx-kernel" fn $name(
            nodes: *const WideNode,
            node_count: u64,
            order: *const u32,
            order_count: u64,
            slots: *const u32,
            slot_count: u64,
            queries: *const Query,
            answers: *mut $answer,
            count: u64,
        ) {
            let i = thread();
            if i < count {
                // SAFETY: as promised by the caller; i is within both arrays.
                unsafe {
                    let tree = tree(nodes, node_count, order, order_count, slots, slot_count);
                    let (query, answer) = (&*queries.add(i as usize), &mut *answers.add(i as usize));
                    $query(&tree, query, answer);
                }
            }
        }
    };
}

of_a_tree! {
    /// A light of each query.
    light_sample: sample -> Chosen
}

of_a_tree! {
    /// The probability of the other light of each query.
    light_pmf: pmf -> f32
}

of_a_tree! {
    /// Four lights of each query, by a cut.
    light_sample_by_cut: sample_by_cut -> Choices
}

/// What arrives from light `other` of each query.
///
/// # Safety
/// The pointers lead to so many elements; nobody else writes the answers.
#[unsafe(no_mangle)]
pub unsafe extern "ptx-kernel" fn light_sample_li(
    lights: *const LightRecord,
    queries: *const Query,
    answers: *mut Arrived,
    count: u64,
) {
    let i = thread();
    if i < count {
        // SAFETY: as promised by the caller; i is within both arrays.
        unsafe {
            let query = &*queries.add(i as usize);
            *answers.add(i as usize) = arrive(&*lights.add(query.other as usize), query);
        }
    }
}

/// The unit vector of each octahedral code.
///
/// # Safety
/// The pointers lead to so many elements; nobody else writes the answers.
#[unsafe(no_mangle)]
pub unsafe extern "ptx-kernel" fn light_octahedral_decode(
    codes: *const u32,
    answers: *mut [f32; 3],
    count: u64,
) {
    let i = thread();
    if i < count {
        // SAFETY: as promised by the caller; i is within both arrays.
        unsafe { *answers.add(i as usize) = decode(*codes.add(i as usize)) };
    }
}
