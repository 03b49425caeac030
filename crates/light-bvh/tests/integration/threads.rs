//! The trees do not depend on the number of threads that build it.

use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::{LightBounds, LightExtent};
use light_bvh::reference::ReferenceLightBvh;
use light_bvh::{LightBvh, LightBvhOptions};
use light_testkit::Rng;
use rayon::ThreadPoolBuilder;

fn lights() -> Vec<LightExtent> {
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
    (0..20_000).map(light).collect()
}

/// What `build` makes on one thread and on four.
fn on_one_and_four<T: Send>(build: impl Fn() -> T + Sync) -> [T; 2] {
    [1, 4].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads").install(&build)
    })
}

#[test]
fn one_thread_and_four_build_the_same_reference_tree() {
    let lights = lights();
    let build = || ReferenceLightBvh::build(&lights).expect("valid lights");
    let [one, four] = on_one_and_four(build);
    assert_eq!(one.view().nodes(), four.view().nodes(), "nodes");
    assert_eq!(one.view().trails(), four.view().trails(), "trails");
}

#[test]
fn one_thread_and_four_build_the_same_default_tree() {
    let lights = lights();
    for options in [LightBvhOptions::QUALITY, LightBvhOptions::FAST] {
        let build = || LightBvh::build_with(&lights, &options).expect("valid lights");
        let [one, four] = on_one_and_four(build);
        let (one, four) = (one.view(), four.view());
        assert_eq!(one.nodes(), four.nodes(), "nodes");
        assert_eq!(one.order(), four.order(), "lights");
        assert_eq!(one.slots(), four.slots(), "ways back");
    }
}
