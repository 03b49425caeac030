//! Laws of the reference tree on lights and receivers of every kind and size.

use light_bvh::light_bounds::light_math::{Aabb, Frame, glam::Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext};
use light_bvh::reference::{Link, ReferenceLightBvh, ReferenceLightBvhRef, Side};
use light_testkit::edge_cases;
use proptest::prelude::*;

fn place() -> impl Strategy<Value = Vec3> {
    prop_oneof![
        edge_cases::point(),
        edge_cases::wild_point(),
        Just(Vec3::ONE)
    ]
}

/// Axes of all directions, and many that differ by a hair.
fn axis() -> impl Strategy<Value = Vec3> {
    let hair = (edge_cases::unit_vector(), 0i32..30);
    let near_z = hair.prop_map(|(w, e)| (Vec3::Z + w * 0.5f32.powi(e)).normalize_or(Vec3::Z));
    prop_oneof![edge_cases::unit_vector(), near_z]
}

fn cosine() -> impl Strategy<Value = f32> {
    prop_oneof![
        -1.0f32..=1.0,
        Just(1.0),
        Just(0.0),
        Just(-1.0),
        0.999f32..=1.0
    ]
}

fn light() -> impl Strategy<Value = LightBounds> {
    let corners = (place(), prop_oneof![Just(Vec3::ZERO), edge_cases::point()]);
    let power = prop_oneof![4 => edge_cases::moderate(), 1 => edge_cases::non_negative()];
    (corners, axis(), power, cosine(), cosine(), any::<bool>()).prop_map(
        |((p, size), w, phi, cos_theta_o, cos_theta_e, two_sided)| LightBounds {
            bounds: Aabb::new(p, p + size),
            w,
            phi,
            cos_theta_o,
            cos_theta_e,
            two_sided,
        },
    )
}

fn context() -> impl Strategy<Value = LightSampleContext> {
    let normal = prop_oneof![Just(Vec3::ZERO), edge_cases::near_unit_vector()];
    (place(), normal).prop_map(|(p, n)| LightSampleContext::surface(p, n, n))
}

fn build(lights: &[LightBounds]) -> ReferenceLightBvh {
    let lights: Vec<_> = lights.iter().copied().map(LightExtent::Bounded).collect();
    ReferenceLightBvh::build(&lights).expect("valid lights")
}

/// The nodes on the way to `light`, the root first.
fn way(tree: &ReferenceLightBvhRef<'_>, light: LightId) -> Vec<usize> {
    let mut nodes = vec![0];
    let mut index = 0;
    for side in tree.trail(light).sides() {
        if let Link::Interior { second_child } = tree.nodes()[index].link() {
            index = match side {
                Side::First => index + 1,
                Side::Second => second_child as usize,
            };
            nodes.push(index);
        }
    }
    nodes
}

/// Between vectors of any length, in double precision.
fn angle(a: Vec3, b: Vec3) -> f64 {
    let [a, b] = [a, b].map(|v| v.to_array().map(f64::from));
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (la, lb) = (length(a), length(b));
    let chord: [f64; 3] = core::array::from_fn(|i| a[i] / la - b[i] / lb);
    2.0 * (0.5 * length(chord)).min(1.0).asin()
}

proptest! {
    #[test]
    fn every_node_contains_its_lights(lights in prop::collection::vec(light(), 1..40)) {
        let tree = build(&lights);
        let view = tree.view();
        for (id, light) in (0..).map(LightId).zip(&lights).filter(|(_, l)| l.phi > 0.0) {
            let nodes = way(&view, id);
            let leaf = view.nodes()[*nodes.last().expect("the root at least")];
            prop_assert_eq!(leaf.link(), Link::Leaf(id), "the way ends at the light");
            for index in nodes {
                let node = view.nodes()[index].bounds().decode(view.bounds());
                prop_assert!(node.bounds.contains_box(&light.bounds), "box of node {}", index);
                prop_assert!(node.cos_theta_e <= light.cos_theta_e, "emission of node {}", index);
                prop_assert!(node.two_sided || !light.two_sided, "sides of node {}", index);
                let needed = angle(node.w, light.w) + f64::from(light.cos_theta_o).acos();
                let theta = f64::from(node.cos_theta_o).acos();
                prop_assert!(
                    node.cos_theta_o == -1.0 || theta >= needed,
                    "cone of node {}: {} of {}", index, theta, needed
                );
            }
        }
    }

    #[test]
    fn samples_repeat_the_pmf_and_pmfs_are_probabilities(
        lights in prop::collection::vec(light(), 0..40),
        ctx in context(),
        u in prop::collection::vec(any::<u64>(), 8),
    ) {
        let tree = build(&lights);
        let ids = || (0..).map(LightId).take(lights.len());
        for u in u {
            if let Some(s) = tree.sample(&ctx, u) {
                prop_assert_eq!(s.pmf.to_bits(), tree.pmf(&ctx, s.light).to_bits());
                prop_assert!(s.pmf > 0.0, "{:?}", s);
            }
            if let Some(s) = tree.sample_emitter(u) {
                prop_assert_eq!(s.pmf.to_bits(), tree.pmf_emitter(s.light).to_bits());
            }
        }
        let sum: f64 = ids().map(|id| f64::from(tree.pmf(&ctx, id))).sum();
        prop_assert!(sum <= 1.0 + 1e-5, "{}", sum);
        let mut of_one_pass = vec![0.0; lights.len()];
        tree.view().for_each_pmf(&ctx, |id, pmf| of_one_pass[id.index()] += pmf);
        for (id, pmf) in ids().zip(of_one_pass) {
            prop_assert_eq!(pmf, tree.pmf(&ctx, id), "{:?} in one pass", id);
        }
        let sum: f64 = ids().map(|id| f64::from(tree.pmf_emitter(id))).sum();
        let expected = f64::from(u8::from(!tree.is_empty()));
        prop_assert!((sum - expected).abs() < 1e-5, "without a context: {}", sum);
    }

    /// One emitter of each light: a point of its box, a normal in its cone.
    #[test]
    fn a_light_that_contributes_can_be_sampled(
        lights in prop::collection::vec(light(), 1..40),
        ctx in context(),
        place in prop::array::uniform3(0.0f32..=1.0),
        tilt in 0.0f32..=1.0,
        turn in 0.0f32..core::f32::consts::TAU,
    ) {
        let tree = build(&lights);
        for (id, light) in (0..).map(LightId).zip(&lights).filter(|(_, l)| l.phi > 0.0) {
            let Aabb { min, max } = light.bounds;
            let emitter = (min + (max - min) * Vec3::from(place)).clamp(min, max);
            let (sin, cos) = (tilt * light.cos_theta_o.acos()).sin_cos();
            let normal = Vec3::new(sin * turn.cos(), sin * turn.sin(), cos);
            let normal = Frame::from_z(light.w).from_local(normal);
            let is_in_cone = angle(normal, light.w).cos() >= f64::from(light.cos_theta_o);

            let to_p = difference(ctx.p, emitter);
            let cos = dot(to_p, normal.to_array().map(f64::from));
            let cos = if light.two_sided { cos.abs() } else { cos };
            let length = (dot(to_p, to_p) * dot_with_itself(normal)).sqrt();
            if is_in_cone && cos > f64::from(light.cos_theta_e) * length {
                prop_assert!(tree.pmf(&ctx, id) > 0.0, "{:?} {} {}", light, emitter, normal);
            }
        }
    }
}

fn difference(a: Vec3, b: Vec3) -> [f64; 3] {
    core::array::from_fn(|i| f64::from(a[i]) - f64::from(b[i]))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn dot_with_itself(a: Vec3) -> f64 {
    dot(a.to_array().map(f64::from), a.to_array().map(f64::from))
}
