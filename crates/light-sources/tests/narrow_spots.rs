//! Spots as narrow as cosines cannot resolve: their bounds hold every direction in which they
//! emit light.

use light_sources::glam::{Affine3A, Vec2, Vec3};
use light_sources::light_bounds::{LightExtent, LightSampleContext};
use light_sources::*;

fn spot(angle: f32, falloff_start: f32) -> Result<SpotLight<Rgb>, SpotLightError> {
    SpotLight::new(SpotLightDesc {
        transform: Affine3A::IDENTITY,
        angle,
        falloff_start,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(2.0),
        media: MediumInterface::default(),
    })
}

#[test]
fn the_bounds_of_narrow_cones_hold_them() -> Result<(), SpotLightError> {
    let angle = |cos_theta: f32| (2.0 * (1.0 - f64::from(cos_theta))).sqrt();
    for i in 0..400u16 {
        let rim = 1e-7 * 1.03f32.powi(i32::from(i));
        for start in [0.0, 0.3 * rim, rim] {
            let spot = spot(rim, start)?;
            let LightExtent::Bounded(bounds) = spot.extent() else {
                panic!("a spot has bounds");
            };
            let held = angle(bounds.cos_theta_o) + angle(bounds.cos_theta_e);
            let is_narrow = rim < 1e-3;
            assert!(
                !is_narrow || held >= f64::from(rim) * (1.0 - 1e-6),
                "{start} {rim}: {held}"
            );
            for u in (0..32u8).map(|i| Vec2::new(f32::from(i) / 32.0, f32::from(i % 8) / 8.0)) {
                let Some(ray) = spot.sample_le(u, Vec2::new(u.y, 0.0), &()) else {
                    continue;
                };
                let ctx = LightSampleContext::medium(ray.ray.direction * 3.0);
                let importance = bounds.importance(&ctx);
                assert!(importance > 0.0, "{start} {rim}: {:?}", ray.ray);
            }
        }
    }
    Ok(())
}
