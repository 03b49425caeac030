//! Lamps that shine up and down a wall, or forward and back along a road: a group of them has no mean
//! axis, and emits along a line.

use light_bvh::LightBvh;
use light_bvh::light_bounds::light_math::glam::{Quat, Vec3};
use light_bvh::light_bounds::light_math::{Aabb, glam};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightSampleContext};
use light_testkit::Rng;

/// The cosine of the edge of every beam.
const EDGE: f32 = 0.94;

/// A beam without a rim.
fn beam(at: Vec3, w: Vec3) -> LightExtent {
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(at),
        w,
        phi: 1.0,
        cos_theta_o: EDGE,
        cos_theta_e: 1.0,
        two_sided: false,
    })
}

/// The mean variance of a choice on the floor of a hall with 20 by 20 posts, each of which has a beam
/// along each of `ways`, all turned by `turn`.
fn variance(ways: &[Vec3], turn: Quat) -> f64 {
    let mut rng = Rng::new(9);
    let (mut lights, mut beams) = (Vec::new(), Vec::new());
    for i in 0..400u16 {
        let place = Vec3::new(f32::from(i % 20), f32::from(i / 20), 0.3 * rng.f32());
        for &w in ways {
            beams.push((place, w));
            lights.push(beam(turn * place, turn * w));
        }
    }
    let tree = LightBvh::build(&lights).expect("valid lights");
    let (mut sum, mut points) = (0.0, 0);
    while points < 60 {
        let p = Vec3::new(19.0 * rng.f32(), 19.0 * rng.f32(), -3.0);
        let here = LightSampleContext::surface(turn * p, turn * Vec3::Z, turn * Vec3::Z);
        let (mut squares, mut total) = (0.0, 0.0);
        tree.view().for_each_pmf(&here, |light, pmf| {
            let (place, w) = beams[light.index()];
            let way = p - place;
            let reaches = w.dot(way) > EDGE * way.length();
            if reaches {
                let gives = f64::from(way.length_squared()).powi(-2);
                total += gives;
                squares += gives * gives / f64::from(pmf);
            }
        });
        if total > 0.0 {
            sum += squares / (total * total) - 1.0;
            points += 1;
        }
    }
    sum / f64::from(points)
}

#[test]
fn beams_up_and_down_are_found_as_those_down_alone() {
    let turns = [
        Quat::IDENTITY,
        Quat::from_rotation_x(0.9),
        Quat::from_euler(glam::EulerRot::XYZ, 0.3, 2.0, 1.0),
    ];
    for turn in turns {
        let down = variance(&[Vec3::NEG_Z], turn);
        let both = variance(&[Vec3::NEG_Z, Vec3::Z], turn);
        assert!(down < 0.4 && both < 0.4, "{down}, both ways {both}");
    }
}
