//! The tree does not depend on the number of threads that build it.
#![cfg(feature = "rayon")]

use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::{LightBounds, LightExtent};
use light_bvh::reference::ReferenceLightBvh;
use light_testkit::Rng;
use rayon::ThreadPoolBuilder;

#[test]
fn one_thread_and_four_build_the_same_tree() {
    let mut rng = Rng::new(41);
    let light = |_| {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(rng.vec3()),
            w: rng.direction(),
            phi: rng.log_range(0.01, 100.0),
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    };
    let lights: Vec<_> = (0..20_000).map(light).collect();
    let build = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads")
            .install(|| ReferenceLightBvh::build(&lights).expect("valid lights"))
    };
    let (one, four) = (build(1), build(4));
    assert_eq!(one.view().nodes(), four.view().nodes(), "nodes");
    assert_eq!(one.view().trails(), four.view().trails(), "trails");
}
