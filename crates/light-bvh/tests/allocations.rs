//! A refit allocates nothing. A program of its own: its allocator counts.

#![cfg(feature = "alloc")]

use core::alloc::{GlobalAlloc, Layout};
use core::cell::Cell;
use std::alloc::System;

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::{LightBounds, LightExtent};
use light_testkit::Rng;
use light_testkit::glam::Vec3;

/// Counts what the thread under test allocates.
struct Counting;

std::thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

// SAFETY: hands every call on to the system's allocator as it is.
#[expect(unsafe_code, reason = "an allocator cannot be written without")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // A thread that ends has no counter any more, and nothing that is counted.
        let _ = ALLOCATIONS.try_with(|count| count.set(count.get() + 1));
        // SAFETY: the caller keeps the contract.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the contract.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Small lamps that shine down.
fn lamps(n: u32, seed: u64) -> Vec<LightExtent> {
    let mut rng = Rng::new(seed);
    let lamp = |_| {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(rng.vec3()),
            w: Vec3::NEG_Z,
            phi: rng.log_range(0.01, 10.0),
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    };
    (0..n).map(lamp).collect()
}

#[test]
fn nothing_is_allocated() {
    // So few that no other thread takes part, which would count for itself.
    let (lights, moved) = (lamps(1500, 1), lamps(1500, 2));
    let mut tree = LightBvh::build(&lights).expect("valid lights");
    let before = ALLOCATIONS.get();
    tree.refit(&moved).expect("as many");
    assert_eq!(ALLOCATIONS.get() - before, 0, "by a refit");
    let before = ALLOCATIONS.get();
    drop(LightBvh::build(&moved));
    assert!(ALLOCATIONS.get() > before, "the counter counts");
}
