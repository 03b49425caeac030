//! Lamps in one row, as along a street: a group of them is long, and a receiver below its end is near to
//! one of its lamps and far from its middle.

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::light_math::glam::{Quat, Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightSampleContext};
use light_testkit::Rng;

/// A small panel that shines along `w`.
fn panel(at: Vec3, w: Vec3) -> LightExtent {
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(at),
        w,
        phi: 1.0,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    })
}

/// The mean variance of a choice below a row of so many lamps, about a metre apart and 0.6 high, turned by
/// `turn`.
fn variance(lamps: u16, turn: Quat) -> f64 {
    let mut rng = Rng::new(u64::from(lamps));
    let places: Vec<_> = (0..lamps)
        .map(|i| Vec3::new(f32::from(i) + 0.3 * rng.f32(), 0.0, 0.6))
        .collect();
    let lights: Vec<_> = places
        .iter()
        .map(|&place| panel(turn * place, turn * Vec3::NEG_Z))
        .collect();
    let tree = LightBvh::build(&lights).expect("valid lights");
    let mut sum = 0.0;
    for _ in 0..200 {
        let p = Vec3::new(f32::from(lamps) * rng.f32(), 0.1, 0.0);
        let here = LightSampleContext::surface(turn * p, turn * Vec3::Z, turn * Vec3::Z);
        let (mut squares, mut total) = (0.0, 0.0);
        tree.view().for_each_pmf(&here, |light, pmf| {
            let gives = f64::from(places[light.index()].distance_squared(p)).powi(-2);
            total += gives;
            squares += gives * gives / f64::from(pmf);
        });
        sum += squares / (total * total) - 1.0;
    }
    sum / 200.0
}

#[test]
fn the_lamp_above_is_found_whatever_its_group() {
    let turns = [
        Quat::IDENTITY,
        Quat::from_rotation_y(0.5),
        Quat::from_axis_angle(Vec3::ONE.normalize(), 2.0),
    ];
    // A group and a single lamp; groups of unlike lengths; rows of rows.
    for lamps in [17, 50, 150, 700, 4000] {
        for turn in turns {
            let variance = variance(lamps, turn);
            assert!(variance < 0.35, "{lamps} lamps: {variance}");
        }
    }
}
