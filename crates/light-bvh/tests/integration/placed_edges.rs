//! Placements at the edges of single precision are placed, or refused for what is wrong with them.

use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::light_math::glam::{Quat, Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::{
    InstancedLightBvh, InstancedLightBvhError, LightPrototype, PlacedLight, Placement,
};

/// A spot whose power is nearly nothing beside that of a point: the mean axis of both is so short
/// that its square is no normal number.
#[test]
fn prototypes_with_a_short_mean_axis_are_placed() {
    let lamp = |x: f32, phi, cos_theta_o| {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_point(Vec3::X * x),
            w: Vec3::new(0.36, 0.48, 0.8),
            phi,
            cos_theta_o,
            cos_theta_e: 0.9,
            two_sided: false,
        })
    };
    for exponent in 10..38 {
        let faint = 10.0f32.powi(-exponent);
        let lights = [lamp(0.0, faint, 1.0), lamp(1.0, 7.0, -1.0)];
        let prototype = LightPrototype::new(&lights).expect("valid lights");
        let tree = InstancedLightBvh::build(vec![prototype], &[Placement::at(0, Vec3::ONE)]);
        assert_eq!(tree.map(|tree| tree.light_count()).ok(), Some(2), "{faint}");
    }
}

/// A small copy far away: its coordinates in lengths of the prototype overflow.
#[test]
fn small_copies_within_reach_are_placed() {
    let lamp = LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(Vec3::X),
        w: Vec3::Z,
        phi: 1.0,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    });
    let prototype = LightPrototype::new(&[lamp]).expect("a valid light");
    let at = |y: f32| Placement::new(0, Quat::IDENTITY, 1e-18, Vec3::Y * y).expect("rigid");
    let build = |y| InstancedLightBvh::build(vec![prototype.clone()], &[at(y)]);
    let tree = build(1e34).expect("within reach");
    let beside = LightSampleContext::medium(Vec3::new(1e34, 1e34, 0.0));
    assert!(
        tree.sample(&beside, 1 << 63).is_some(),
        "found by its power"
    );
    let far = InstancedLightBvhError::TooFar { placement: 0 };
    assert_eq!(build(2e36).err(), Some(far), "beyond reach");
}

/// The box of one light is so large that the round-off of a placed receiver, in lengths of the
/// other lights, has a square above all floats.
#[test]
fn small_lights_beside_a_huge_one_are_not_lost() {
    let lamp = |min: Vec3, max: Vec3, phi| {
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::new(min, max),
            w: Vec3::NEG_X,
            phi,
            cos_theta_o: -1.0,
            cos_theta_e: 0.8,
            two_sided: false,
        })
    };
    let mut lights = vec![lamp(Vec3::Y * -2.5e29, Vec3::Z * 212.0, 4e26)];
    let small = (0..40u8).map(|i| Vec3::new(f32::from(i % 7), f32::from(i % 5), f32::from(i % 3)));
    lights.extend(small.map(|p| lamp(p, p, 17.0)));
    let prototype = LightPrototype::new(&lights).expect("valid lights");
    let placed = Placement::at(0, Vec3::new(5.0, 1.0, 0.0));
    let tree = InstancedLightBvh::build(vec![prototype], &[placed]).expect("within reach");
    let p = Vec3::new(-3.0, -2.3, -254.0);
    for ctx in [
        LightSampleContext::two_sided(p, Vec3::NEG_Y, Vec3::NEG_Y),
        LightSampleContext::surface(p, Vec3::Y, Vec3::Y),
        LightSampleContext::medium(p),
        LightSampleContext::segment(p, Vec3::Z),
    ] {
        for light in (0..41).map(LightId) {
            let placement = 0;
            let pmf = tree.pmf(&ctx, PlacedLight { placement, light });
            assert!(pmf > 0.0, "{light:?} at {ctx:?}");
        }
    }
}
