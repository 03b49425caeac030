//! Placements that reach into others are opened: their lights are told apart by the upper tree.

use light_bvh::light_bounds::light_math::Aabb;
use light_bvh::light_bounds::light_math::fraction::stratum;
use light_bvh::light_bounds::light_math::glam::{Quat, Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightGroups, LightId, LightSampleContext};
use light_bvh::{
    InstancedLightBvh, InstancedLightBvhError, LightBvh, LightBvhOptions, LightPrototype,
    PlacedLight, Placement,
};
use light_testkit::Rng;

/// Lights of a prototype, within the unit cube about the origin.
const LIGHTS: u32 = 100;

fn lamps(rng: &mut Rng) -> Vec<LightExtent> {
    let lamp = |_| {
        let p = rng.vec3() - 0.5;
        LightExtent::Bounded(LightBounds {
            bounds: Aabb::from_points([p, p + 0.01 * rng.direction()]),
            w: rng.direction(),
            phi: rng.log_range(0.1, 10.0),
            cos_theta_o: 1.0,
            cos_theta_e: 0.0,
            two_sided: false,
        })
    };
    (0..LIGHTS).map(lamp).collect()
}

/// Copies that are so far apart along a line.
fn row(count: u16, apart: f32) -> Vec<Placement> {
    let at = |i: u16| Placement::at(0, Vec3::X * (f32::from(i) * apart));
    (0..count).map(at).collect()
}

fn build(
    lights: &[LightExtent],
    placements: &[Placement],
    most_opened: usize,
) -> InstancedLightBvh {
    let prototype = LightPrototype::new(lights).expect("valid lights");
    let options = LightBvhOptions::default();
    InstancedLightBvh::build_opening(vec![prototype], placements, &options, most_opened)
        .expect("within reach")
}

/// How many leaves the upper tree has a place for.
fn leaves(tree: &InstancedLightBvh) -> usize {
    tree.top().view().order().len()
}

#[test]
fn placements_that_reach_into_others_are_opened() {
    let lights = lamps(&mut Rng::new(1));
    let per = LIGHTS as usize;
    let apart = |apart| leaves(&build(&lights, &row(20, apart), usize::MAX));
    assert_eq!(apart(3.0), 20, "far apart");
    assert_eq!(apart(1.0), 20, "side by side");
    assert_eq!(apart(0.5), 20 * per, "each into its neighbours");
    let crowd = row(20, 0.2);
    for most in [0, 99, 100, 950, 2000] {
        let opened = most / per;
        let expected = opened * per + 20 - opened;
        assert_eq!(leaves(&build(&lights, &crowd, most)), expected, "{most}");
    }
    let far_from_a_pair = [Vec3::ZERO, Vec3::X * 0.5, Vec3::Y * 9.0];
    let placements = far_from_a_pair.map(|at| Placement::at(0, at));
    let tree = build(&lights, &placements, usize::MAX);
    assert_eq!(leaves(&tree), 2 * per + 1, "the pair alone");
}

/// Opened placements, moved without a turn, are a flat tree of the same lights.
#[test]
fn opened_lights_have_about_the_pmf_of_copies() {
    let mut rng = Rng::new(2);
    let (lights, placements) = (lamps(&mut rng), row(16, 0.25));
    let tree = build(&lights, &placements, usize::MAX);
    let copies = (0..16u8).flat_map(|i| {
        let by = Vec3::X * (0.25 * f32::from(i));
        lights.iter().map(move |light| moved(light, by))
    });
    let flat = LightBvh::build(&copies.collect::<Vec<_>>()).expect("valid lights");
    let (mut difference, mut count) = (0.0, 0.0);
    for _ in 0..64 {
        let p = Vec3::new(4.0, 1.0, 1.0) * rng.vec3() - Vec3::new(0.0, 0.5, 0.5);
        let ctx = LightSampleContext::surface(p, Vec3::Z, Vec3::Z);
        let (here, mut sum) = (tree.at(&ctx), 0.0);
        for index in 0..tree.light_count() {
            let light = tree.light_of_index(index).expect("a light");
            let pmf = tree.pmf(&ctx, light);
            assert_eq!(here.pmf(light), pmf, "{light:?}");
            let id = LightId(u32::try_from(index).expect("few"));
            difference += f64::from((flat.pmf(&ctx, id) - pmf).abs());
            sum += f64::from(pmf);
        }
        assert!(sum < 1.0 + 1e-5, "{sum}");
        count += 1.0;
        for i in 0..64 {
            let u = stratum(i, 64, 1 << 50);
            let sampled = tree.sample(&ctx, u);
            assert_eq!(here.sample(u), sampled, "{u}");
            if let Some(sampled) = sampled {
                assert_eq!(tree.pmf(&ctx, sampled.light), sampled.pmf, "{sampled:?}");
            }
        }
    }
    assert!(difference / count < 0.01, "{}", difference / count);
}

fn moved(light: &LightExtent, by: Vec3) -> LightExtent {
    let mut light = *light;
    if let LightExtent::Bounded(bounds) = &mut light {
        bounds.bounds = Aabb::new(bounds.bounds.min + by, bounds.bounds.max + by);
    }
    light
}

#[test]
fn opened_placements_have_groups_and_emitters() {
    let lights = lamps(&mut Rng::new(3));
    let mut tree = build(&lights, &row(4, 0.25), usize::MAX);
    let groups = [1, 2, 1, 2].map(LightGroups);
    tree.set_groups(&groups).expect("one for each placement");
    let refused = InstancedLightBvhError::OtherPlacements { expected: 4 };
    assert_eq!(
        tree.set_groups(&groups[1..]),
        Err(refused),
        "one is missing"
    );
    let mut ctx = LightSampleContext::medium(Vec3::ZERO);
    ctx.groups = LightGroups(2);
    let (mut sum, mut emitted) = (0.0, 0.0);
    for index in 0..tree.light_count() {
        let light = tree.light_of_index(index).expect("a light");
        let pmf = tree.pmf(&ctx, light);
        assert_eq!(pmf > 0.0, light.placement % 2 == 1, "{light:?}");
        sum += pmf;
        emitted += tree.pmf_emitter(light);
    }
    assert!(
        (sum - 1.0).abs() < 1e-4 && (emitted - 1.0).abs() < 1e-4,
        "{sum}, {emitted}"
    );
    for i in 0..64 {
        let sampled = tree.sample_emitter(stratum(i, 64, 0)).expect("a light");
        assert_eq!(tree.pmf_emitter(sampled.light), sampled.pmf, "{sampled:?}");
    }
    for (placement, light) in [
        (0, LIGHTS),
        (3, LIGHTS),
        (4, 0),
        (u32::MAX, 0),
        (0, u32::MAX),
    ] {
        let light = LightId(light);
        let none = PlacedLight { placement, light };
        assert_eq!(tree.pmf(&ctx, none), 0.0, "{none:?}");
    }
}

/// Which placements are opened is a choice of the build: a refit moves their lights.
#[test]
fn opened_placements_are_refitted() {
    let mut rng = Rng::new(4);
    let lights = lamps(&mut rng);
    let crowd = row(4, 0.25);
    let mut tree = build(&lights, &crowd, usize::MAX);
    let mut apart = row(4, 30.0);
    apart[3] = apart[3].with_power(0.0).expect("dark");
    tree.refit(&apart).expect("the same prototypes");
    let ctx = LightSampleContext::medium(Vec3::X * 30.0);
    let pmf = |tree: &InstancedLightBvh, placement: u32| -> f32 {
        let of = |light| tree.pmf(&ctx, PlacedLight { placement, light });
        (0..LIGHTS).map(LightId).map(of).sum()
    };
    assert!(pmf(&tree, 1) > 0.9, "the receiver is in it");
    assert_eq!(pmf(&tree, 3), 0.0, "dark");
    tree.refit(&row(4, 30.0)).expect("it has a place");
    assert!(pmf(&tree, 3) > 0.0, "on again");

    let off: Vec<_> = lights.iter().map(|light| scaled(light, 0.0)).collect();
    tree.refit_prototype(0, &off, &crowd).expect("all are off");
    assert_eq!(pmf(&tree, 1), 0.0, "dark");
    tree.refit_prototype(0, &lights, &crowd).expect("as built");
    let fresh = build(&lights, &crowd, usize::MAX);
    for placement in 0..4 {
        assert_eq!(pmf(&tree, placement), pmf(&fresh, placement), "as built");
    }

    let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 1.0);
    let mirrored = |i: u8| Placement::new(0, turn, -2.0, Vec3::X * f32::from(i)).expect("rigid");
    tree.refit(&[0, 1, 2, 3].map(mirrored)).expect("mirrored");
    let sum: f32 = (0..4).map(|placement| pmf(&tree, placement)).sum();
    assert!((sum - 1.0).abs() < 1e-4, "{sum}");
}

fn scaled(light: &LightExtent, by: f32) -> LightExtent {
    let mut light = *light;
    if let LightExtent::Bounded(bounds) = &mut light {
        bounds.phi *= by;
    }
    light
}

/// A light that was dark when a placement was opened has no place, as one of a prototype.
#[test]
fn a_dark_light_of_an_opened_placement_has_no_place() {
    let lights = lamps(&mut Rng::new(6));
    let mut dark = lights.clone();
    dark[7] = scaled(&dark[7], 0.0);
    let kept =
        LightPrototype::with_options(&dark, &LightBvhOptions::DYNAMIC).expect("valid lights");
    let placements = row(2, 0.25);
    let mut tree = InstancedLightBvh::build(vec![kept], &placements).expect("within reach");
    let refused = InstancedLightBvhError::NoPlace { placement: 0 };
    let result = tree.refit_prototype(0, &lights, &placements);
    assert_eq!(result, Err(refused), "the upper tree keeps no dark lights");
}
