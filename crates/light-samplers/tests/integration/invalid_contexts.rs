//! What a tree says of the irradiance is a finite number, whatever the context.

use light_bvh::CutDetail;
use light_samplers::BvhLightSampler;
use light_testkit::laws::sampler_cases;
use light_testkit::laws::sampler_contexts::invalid_contexts;

#[test]
fn the_irradiance_is_finite_at_any_context() {
    for set in sampler_cases() {
        let sampler = BvhLightSampler::new(&set.extents()).expect("valid bounds");
        let tree = sampler.tree().view();
        for ctx in set.contexts.iter().flat_map(invalid_contexts) {
            let cut = tree.cut(&ctx, CutDetail::default());
            for irradiance in [tree.at(&ctx).irradiance(), cut.irradiance()] {
                assert!(
                    (0.0..=f32::MAX).contains(&irradiance),
                    "{}: {irradiance} at {ctx:?}",
                    set.name
                );
            }
        }
    }
}
