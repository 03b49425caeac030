use light_bounds::{LightId, LightSampleContext};
use light_math::glam::Vec3;
use light_sources::{
    IntensityAmount, LightRef, LightSet, LightSetBuilder, OwnLight, PointLightDesc, RadianceAmount,
    Rgb, SunAmount, SunLightDesc,
};
use light_testkit::laws::light::*;
use light_testkit::{Cap, Emitter, own_twin};

use super::ball::{Ball, DARKENING};
use super::lantern::Lantern;
use super::{SCENE_RADIUS, scene};

/// A set of a lamp and an own light, which is the light 1.
fn beside_a_lamp(own: OwnLight<Rgb>) -> LightSet<Rgb> {
    let mut builder = LightSetBuilder::new(scene());
    let amount = IntensityAmount::Radiometric(1.0);
    let lamp = PointLightDesc::new(Vec3::splat(-3.0), Vec3::ONE, amount);
    builder.add(lamp).expect("a lamp");
    builder.add(own).expect("an own light");
    builder.build()
}

fn own(set: &LightSet<Rgb>) -> LightRef<'_, Rgb> {
    set.get(LightId(1)).expect("the light behind the lamp")
}

#[test]
fn own_point() {
    let (position, axis, cos_beam) = (Vec3::new(1.0, 2.0, -1.0), Vec3::Z, 0.8);
    let (beam, stray) = (5.0, 1.0);
    let emitter = Emitter::Lantern {
        position,
        axis,
        beam,
        stray,
        cos_beam,
    };
    let set = beside_a_lamp(Lantern::own(&emitter).expect("a lantern"));
    let light = own(&set);
    let case = LightCase::around("own point", &light, position, 1.0, 24);
    dirac_li_is(&case, |p| {
        let away = (p - position).as_dvec3();
        let is_in_beam = away.z > f64::from(cos_beam) * away.length();
        f64::from(if is_in_beam { beam } else { stray }) / away.length_squared()
    });
    le_adds_up_to_phi(&case);
    flux_is_phi(&case);
    le_directions_follow_their_density(&case, &Cap::sphere(), position);
    rays_and_samples_light_alike(&case, position, 1.0);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn own_area() {
    let (center, radius, radiance) = (Vec3::new(0.5, -1.0, 2.0), 0.7, 2.0);
    let set = beside_a_lamp(Ball::own(center, radius, radiance));
    let light = own(&set);
    let mut case = LightCase::around("own area", &light, center, 2.0 * radius, 18);
    let is_outside = |ctx: &LightSampleContext| ctx.p.distance(center) > 1.1 * radius;
    case.contexts.retain(is_outside);
    assert!(case.contexts.len() > 8, "{}", case.contexts.len());
    let cap = |p: Vec3| {
        let to = center - p;
        Cap::new(to, f64::from(radius / to.length()).asin() + 1e-3)
    };
    let arriving = |p: Vec3, wi: Vec3| {
        let (to, wi) = ((center - p).as_dvec3(), wi.as_dvec3().normalize());
        let beside_sq = (to - wi * to.dot(wi)).length_squared();
        let mu = (1.0 - beside_sq / f64::from(radius).powi(2)).sqrt();
        // NaN beside the ball.
        if mu > 0.0 {
            f64::from(radiance) * (1.0 - f64::from(DARKENING) * (1.0 - mu))
        } else {
            0.0
        }
    };
    li_follows_its_density(&case, cap, arriving);
    li_adds_up(&case, cap, arriving);
    le_adds_up_to_phi(&case);
    flux_is_phi(&case);
    rays_and_samples_light_alike(&case, center, 2.0 * radius);
    bounds_hold(&case);
    edges_are_survived(&case);
}

#[test]
fn own_infinite() {
    let direction = Vec3::new(0.36, 0.48, 0.8);
    let diameter = 0.5;
    let amount = SunAmount::Radiance(RadianceAmount::Radiometric(2.0));
    let sun = SunLightDesc {
        direction,
        angular_diameter: diameter,
        emission: Vec3::ONE,
        amount,
    };
    let set = beside_a_lamp(own_twin(sun, scene()).expect("a sun"));
    let light = own(&set);
    let case = LightCase::around("own infinite", &light, Vec3::ZERO, 1.0, 12);
    let cap = |_| Cap::new(direction, 0.525 * f64::from(diameter));
    let cos = (0.5 * f64::from(diameter)).cos();
    let arriving = |_, wi: Vec3| {
        let is_sun = wi.as_dvec3().normalize().dot(direction.as_dvec3()) > cos;
        if is_sun { 2.0 } else { 0.0 }
    };
    li_follows_its_density(&case, cap, arriving);
    li_adds_up(&case, cap, arriving);
    le_adds_up_to_phi(&case);
    rays_and_samples_light_alike(&case, Vec3::ZERO, 0.5 * SCENE_RADIUS);
    bounds_hold(&case);
    edges_are_survived(&case);
}
