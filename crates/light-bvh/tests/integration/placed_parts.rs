//! Lights of a prototype that emit in unlike directions are parts of it: each is a leaf of the upper
//! tree.

use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::{Quat, Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightGroups, LightSampleContext};
use light_bvh::{
    InstancedLightBvh, InstancedLightBvhError, LightBvhOptions, LightPrototype, PlacedLight,
    Placement,
};
use light_testkit::Rng;

/// Lights of a prototype.
const LIGHTS: u16 = 200;

/// A small flat light.
fn window(p: Vec3, w: Vec3, rng: &mut Rng) -> LightExtent {
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_points([p, p + 0.01 * w.any_orthonormal_vector()]),
        w,
        phi: rng.log_range(0.1, 10.0),
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    })
}

/// Windows in four walls that face outward, of a house in the unit cube about the origin.
fn house(rng: &mut Rng) -> Vec<LightExtent> {
    let windows = (0..LIGHTS).map(|i| {
        let wall = Quat::from_rotation_z(core::f32::consts::FRAC_PI_2 * f32::from(i % 4));
        let at = Vec3::new(0.5, rng.f32() - 0.5, rng.f32() - 0.5);
        window(wall * at, wall * Vec3::X, rng)
    });
    windows.collect()
}

/// Houses along a street, so far apart, turned and scaled.
fn street(count: u16, apart: f32) -> Vec<Placement> {
    let place = |i: u16| {
        let turn = Quat::from_rotation_z(0.7 * f32::from(i));
        let scale = if i % 2 == 0 { 1.0 } else { -0.75 };
        Placement::new(0, turn, scale, Vec3::X * (f32::from(i) * apart)).expect("rigid")
    };
    (0..count).map(place).collect()
}

fn build(lights: &[LightExtent], placements: &[Placement]) -> InstancedLightBvh {
    let prototype = LightPrototype::new(lights).expect("valid lights");
    InstancedLightBvh::build(vec![prototype], placements).expect("within reach")
}

/// How many leaves of the upper tree have a place.
fn leaves(tree: &InstancedLightBvh) -> usize {
    tree.top().view().order().len()
}

#[test]
fn directions_that_belong_to_places_are_parts() {
    let mut rng = Rng::new(1);
    let parts = |lights: &[LightExtent]| leaves(&build(lights, &[Placement::at(0, Vec3::ZERO)]));
    let set = |count: u16, rng: &mut Rng, light: &dyn Fn(u16, &mut Rng) -> LightExtent| {
        (0..count).map(|i| light(i, rng)).collect::<Vec<_>>()
    };
    assert_eq!(parts(&house(&mut rng)), 4, "the walls of a house");
    assert_eq!(parts(&house(&mut rng)[..48]), 1, "of few windows");
    let bulb = |_, rng: &mut Rng| {
        let w = rng.direction();
        window(w, w, rng)
    };
    assert_eq!(parts(&set(200, &mut rng, &bulb)), 1, "a bulb");
    let tower = |i, rng: &mut Rng| {
        let wall = Quat::from_rotation_z(core::f32::consts::FRAC_PI_4 * f32::from(i % 8));
        let at = Vec3::new(0.5, 0.4 * (rng.f32() - 0.5), rng.f32());
        window(wall * at, wall * Vec3::X, rng)
    };
    assert_eq!(
        parts(&set(200, &mut rng, &tower)),
        1,
        "a tower of eight walls"
    );
    let mut roofed = house(&mut rng);
    let roof = |_, rng: &mut Rng| {
        let at = Vec3::new(rng.f32(), rng.f32(), 1.0) - 0.5;
        window(at, Vec3::Z, rng)
    };
    roofed.extend(set(50, &mut rng, &roof));
    assert_eq!(parts(&roofed), 5, "a house with a roof");
    let inward = |i, rng: &mut Rng| {
        let wall = Quat::from_rotation_z(core::f32::consts::FRAC_PI_2 * f32::from(i % 4));
        let at = Vec3::new(0.5, rng.f32() - 0.5, rng.f32() - 0.5);
        window(wall * at, wall * Vec3::NEG_X, rng)
    };
    assert_eq!(parts(&set(200, &mut rng, &inward)), 1, "walls of a court");
    let leaf = |_, rng: &mut Rng| window(rng.vec3(), rng.direction(), rng);
    assert_eq!(parts(&set(200, &mut rng, &leaf)), 1, "leaves of a tree");
    let panel = |_, rng: &mut Rng| window(rng.vec3(), Vec3::NEG_Z, rng);
    assert_eq!(parts(&set(200, &mut rng, &panel)), 1, "one direction");
    let point = |i, rng: &mut Rng| {
        let light = window(Vec3::X * f32::from(i), Vec3::Z, rng);
        let mut bounds = *light.bounded().expect("bounded");
        bounds.cos_theta_o = -1.0;
        LightExtent::Bounded(bounds)
    };
    assert_eq!(parts(&set(200, &mut rng, &point)), 1, "no direction");
    assert_eq!(parts(&[]), 0, "no light");
}

#[test]
fn parts_obey_the_laws() {
    let mut rng = Rng::new(2);
    let tree = build(&house(&mut rng), &street(9, 3.0));
    assert_eq!(leaves(&tree), 9 * 4, "none is opened");
    let emitted: f32 = all(&tree).map(|light| tree.pmf_emitter(light)).sum();
    assert!((emitted - 1.0).abs() < 1e-4, "{emitted}");
    for i in 0..64 {
        let sampled = tree.sample_emitter(stratum(i, 64, 0)).expect("a light");
        assert_eq!(tree.pmf_emitter(sampled.light), sampled.pmf, "{sampled:?}");
    }
    for k in 0..64 {
        let p = Vec3::new(30.0, 8.0, 2.0) * (rng.vec3() - Vec3::new(0.1, 0.5, 0.5));
        let ctx = if k % 2 == 0 {
            LightSampleContext::medium(p)
        } else {
            let n = rng.direction();
            LightSampleContext::surface(p, n, n)
        };
        let here = tree.at(&ctx);
        let mut sum = 0.0;
        for light in all(&tree) {
            let pmf = tree.pmf(&ctx, light);
            assert_eq!(here.pmf(light), pmf, "{light:?}");
            sum += pmf;
        }
        let mut chosen = 0.0;
        for i in 0..64 {
            let u = stratum(i, 64, 1 << 50);
            let sampled = tree.sample(&ctx, u);
            assert_eq!(here.sample(u), sampled, "{u}");
            if let Some(sampled) = sampled {
                assert_eq!(tree.pmf(&ctx, sampled.light), sampled.pmf, "{sampled:?}");
                chosen += 1.0 / 64.0;
            }
        }
        assert!(
            sum < 1.0 + 1e-5 && (sum - chosen).abs() < 0.1,
            "{sum}, {chosen}"
        );
    }
}

/// All lights of a tree.
fn all(tree: &InstancedLightBvh) -> impl Iterator<Item = PlacedLight> + '_ {
    (0..tree.light_count()).map(|index| tree.light_of_index(index).expect("a light"))
}

#[test]
fn a_light_that_can_contribute_can_be_chosen() {
    let mut rng = Rng::new(3);
    let lights = house(&mut rng);
    let placements = street(5, 3.0);
    let tree = build(&lights, &placements);
    let mut contributing = 0;
    for _ in 0..64 {
        let p = Vec3::new(15.0, 6.0, 2.0) * (rng.vec3() - Vec3::new(0.1, 0.5, 0.5));
        let n = rng.direction();
        let ctx = LightSampleContext::surface(p, n, n);
        for light in all(&tree) {
            let i = light.placement;
            let turn = Quat::from_rotation_z(0.7 * i as f32);
            let scale = if i % 2 == 0 { 1.0 } else { -0.75 };
            let bounds = lights[light.light.index()].bounded().expect("a window");
            let at = Vec3::X * (i as f32 * 3.0) + turn * (bounds.bounds.center() * scale);
            let axis = turn * bounds.w * f32::signum(scale);
            let to_point = (p - at).normalize();
            if axis.dot(to_point) > 1e-2 && n.dot(to_point) < -1e-2 {
                contributing += 1;
                assert!(tree.pmf(&ctx, light) > 0.0, "{light:?} at {p}");
            }
        }
    }
    assert!(contributing > 1000, "{contributing}");
}

#[test]
fn groups_are_those_of_placements() {
    let mut tree = build(&house(&mut Rng::new(4)), &street(4, 3.0));
    let groups = [1, 2, 1, 2].map(LightGroups);
    tree.set_groups(&groups).expect("one for each placement");
    let refused = InstancedLightBvhError::OtherPlacements { expected: 4 };
    assert_eq!(
        tree.set_groups(&groups[1..]),
        Err(refused),
        "one is missing"
    );
    let mut ctx = LightSampleContext::medium(Vec3::Y);
    ctx.groups = LightGroups(2);
    for light in all(&tree) {
        let pmf = tree.pmf(&ctx, light);
        assert!(pmf == 0.0 || light.placement % 2 == 1, "{light:?}");
    }
    let sampled = tree.sample(&ctx, 1 << 63).expect("a light");
    assert_eq!(sampled.light.placement % 2, 1, "of the group");
}

#[test]
fn parts_are_refitted() {
    let mut rng = Rng::new(5);
    let (lights, placements) = (house(&mut rng), street(6, 3.0));
    let mut tree = build(&lights, &placements);
    let fresh = tree.clone();
    let ctx = LightSampleContext::medium(Vec3::new(4.0, 2.0, 0.0));
    let pmfs = |tree: &InstancedLightBvh| -> Vec<f32> {
        all(tree).map(|light| tree.pmf(&ctx, light)).collect()
    };
    // Each window turns to where another wall faces, and one wall is off.
    let turn = Quat::from_rotation_z(2.0);
    let other = lights.iter().enumerate().map(|(i, light)| {
        let mut bounds = *light.bounded().expect("a window");
        bounds.w = turn * bounds.w;
        bounds.phi *= if i % 4 == 0 { 0.0 } else { 3.0 };
        LightExtent::Bounded(bounds)
    });
    let other: Vec<_> = other.collect();
    tree.refit_prototype(0, &other, &placements)
        .expect("the same lights");
    for (light, pmf) in all(&tree).zip(pmfs(&tree)) {
        assert!(pmf == 0.0 || light.light.0 % 4 != 0, "{light:?} is off");
    }
    let sum: f32 = pmfs(&tree).iter().sum();
    assert!(sum > 0.5 && sum < 1.0 + 1e-5, "{sum}");
    tree.refit_prototype(0, &lights, &street(6, 9.0))
        .expect("moved");
    assert_ne!(pmfs(&tree), pmfs(&fresh), "the placements moved");
    tree.refit(&placements).expect("and back");
    assert_eq!(pmfs(&tree), pmfs(&fresh), "as built");
}

#[test]
fn a_dark_wall_has_a_place_if_that_is_wanted() {
    let lights = house(&mut Rng::new(6));
    let dark = lights.iter().enumerate().map(|(i, light)| {
        let mut bounds = *light.bounded().expect("a window");
        bounds.phi *= if i % 4 == 0 { 0.0 } else { 1.0 };
        LightExtent::Bounded(bounds)
    });
    let dark: Vec<_> = dark.collect();
    let placements = street(3, 3.0);
    let parts = |options: &LightBvhOptions| {
        let prototype = LightPrototype::with_options(&dark, options).expect("valid lights");
        let tree = InstancedLightBvh::build_with(vec![prototype], &placements, options);
        tree.expect("within reach")
    };
    assert_eq!(leaves(&parts(&LightBvhOptions::QUALITY)), 3 * 3, "left out");
    let mut kept = parts(&LightBvhOptions::DYNAMIC);
    assert_eq!(leaves(&kept), 3 * 4, "kept");
    kept.refit_prototype(0, &lights, &placements).expect("on");
    let ctx = LightSampleContext::medium(Vec3::Y);
    let sum: f32 = all(&kept).map(|light| kept.pmf(&ctx, light)).sum();
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
}

#[test]
fn houses_that_reach_into_each_other_are_opened_whole() {
    let lights = house(&mut Rng::new(7));
    let mut placements = street(4, 9.0);
    placements.extend(street(2, 0.3));
    let tree = build(&lights, &placements);
    let all_lights = usize::from(LIGHTS);
    // The first of the street and the two among it.
    assert_eq!(leaves(&tree), 3 * 4 + 3 * all_lights, "three are opened");
    let ctx = LightSampleContext::medium(Vec3::Y);
    let sum: f32 = all(&tree).map(|light| tree.pmf(&ctx, light)).sum();
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    for i in 0..64 {
        let sampled = tree.sample(&ctx, stratum(i, 64, 0)).expect("a light");
        assert_eq!(tree.pmf(&ctx, sampled.light), sampled.pmf, "{sampled:?}");
    }
}
