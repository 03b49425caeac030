//! The laws of scattering functions.

use super::*;
use core::f32::consts::{FRAC_1_PI, PI, TAU};
use lights::math::warp::{cosine_hemisphere, uniform_sphere};

fn subjects() -> Vec<(&'static str, Bsdf)> {
    let facets = |x, y| Microfacets::new(Vec2::new(x, y));
    let glass = |eta, facets| Bsdf::Dielectric(Dielectric { eta, facets });
    vec![
        (
            "paint",
            Bsdf::Lambert(Lambert::opaque(Vec3::new(0.2, 0.5, 0.9))),
        ),
        (
            "paper",
            Bsdf::Lambert(Lambert {
                reflectance: Vec3::splat(0.5),
                transmittance: Vec3::splat(0.3),
            }),
        ),
        (
            "metal",
            Bsdf::Conductor(Conductor {
                eta: Vec3::new(0.2, 0.9, 1.1),
                k: Vec3::new(3.9, 2.4, 2.2),
                facets: facets(0.3, 0.5),
            }),
        ),
        ("glass", glass(1.5, facets(0.4, 0.3))),
        ("glass inside out", glass(1.0 / 1.5, facets(0.4, 0.4))),
        (
            "coat",
            Bsdf::CoatedDiffuse(CoatedDiffuse::new(
                Vec3::new(0.1, 0.5, 0.8),
                1.5,
                facets(0.3, 0.3),
            )),
        ),
        ("worn paint", metallic_roughness(0.4, 0.5, None)),
        ("steel", metallic_roughness(1.0, 0.7, None)),
        ("car paint", metallic_roughness(0.6, 0.6, Some([0.8, 0.55]))),
        (
            "coated metal",
            Bsdf::CoatedConductor(CoatedConductor::new(
                Conductor {
                    eta: Vec3::new(0.2, 0.9, 1.1),
                    k: Vec3::new(3.9, 2.4, 2.2),
                    facets: facets(0.4, 0.3),
                },
                1.5,
                facets(0.3, 0.2),
            )),
        ),
    ]
}

fn metallic_roughness(metallic: f32, roughness: f32, clearcoat: Option<[f32; 2]>) -> Bsdf {
    Bsdf::MetallicRoughness(MetallicRoughness::new(&MetallicRoughnessParameters {
        base_color: Vec3::new(0.9, 0.5, 0.2),
        metallic,
        roughness,
        f0: Vec3::new(0.04, 0.05, 0.06),
        f90: 1.0,
        clearcoat,
    }))
}

/// Directions toward the viewer, from above and from below.
fn viewers() -> Vec<Vec3> {
    [(0.1, 0.95), (0.6, 0.7), (0.9, 0.3), (0.5, -0.8)]
        .map(|(x, z)| Vec3::new(x, 0.2, z).normalize())
        .into()
}

/// `n * n` points of the unit square.
fn grid(n: u16) -> impl Iterator<Item = Vec2> {
    (0..n).flat_map(move |i| {
        (0..n).map(move |j| Vec2::new(f32::from(i) + 0.5, f32::from(j) + 0.5) / f32::from(n))
    })
}

#[test]
fn densities_integrate_to_at_most_one() {
    for (name, bsdf) in subjects() {
        for wo in viewers() {
            let n = 250;
            let pdf = |u| bsdf.pdf(wo, uniform_sphere::sample(u));
            let sum: f32 = grid(n).map(pdf).sum::<f32>() * 4.0 * PI / f32::from(n * n);
            // Facets that reflect below the horizon take part of the density with them.
            assert!(sum < 1.01, "{name} from {wo}: {sum}");
            let lost = grid(64)
                .filter(|&u| bsdf.sample(wo, (u.x * 7.3 + u.y).fract(), u).is_none())
                .count() as f32
                / 4096.0;
            assert!(
                (sum + lost - 1.0).abs() < 0.03,
                "{name} from {wo}: {sum} and lost {lost}"
            );
        }
    }
}

#[test]
fn samples_have_the_density_and_weight_that_they_say() {
    for (name, bsdf) in subjects() {
        for wo in viewers() {
            for u in grid(16) {
                let Some(s) = bsdf.sample(wo, (u.x * 7.3 + u.y).fract(), u) else {
                    continue;
                };
                assert!((s.wi.length() - 1.0).abs() < 1e-4, "{name}: a unit vector");
                let pdf = s.pdf.expect("no Dirac among the subjects");
                let asked = bsdf.pdf(wo, s.wi);
                assert!(
                    (asked / pdf - 1.0).abs() < 1e-2,
                    "{name} from {wo}: {asked} and {pdf}"
                );
                let weight = bsdf.eval(wo, s.wi) / pdf;
                let off = weight.distance(s.weight) / s.weight.length();
                assert!(off < 1e-2, "{name} from {wo}: {weight} and {}", s.weight);
            }
        }
    }
}

#[test]
fn no_more_light_leaves_than_arrives() {
    for (name, bsdf) in subjects() {
        for wo in viewers() {
            let n = 64;
            let weights = grid(n).map(|u| {
                bsdf.sample(wo, (u.x * 7.3 + u.y).fract(), u)
                    // Radiance is squeezed by the square of the index; power is not.
                    .map_or(0.0, |s| s.weight.max_element() * s.eta * s.eta)
            });
            let albedo = weights.sum::<f32>() / f32::from(n * n);
            assert!(albedo < 1.01, "{name} from {wo}: {albedo}");
        }
    }
}

#[test]
fn opaque_surfaces_are_reciprocal() {
    for (name, bsdf) in subjects().into_iter().filter(|(_, bsdf)| !bsdf.transmits()) {
        for k in 0..16u8 {
            let phi = f32::from(k) / 16.0 * TAU;
            let a = Vec3::new(0.6, 0.0, 0.8);
            let b = Vec3::new(0.9 * phi.cos(), 0.9 * phi.sin(), 0.435_889_9);
            let there = bsdf.eval(a, b) / b.z;
            let back = bsdf.eval(b, a) / a.z;
            assert!(
                there.distance(back) < 1e-4 * there.length(),
                "{name}: {there} and {back}"
            );
        }
    }
}

#[test]
fn smooth_glass_splits_light_by_the_fresnel_factor() {
    let glass = Dielectric {
        eta: 1.5,
        facets: Microfacets::new(Vec2::ZERO),
    };
    assert!(glass.is_dirac(), "smooth");
    let up = glass
        .sample(Vec3::Z, 0.0399, Vec2::ZERO)
        .expect("reflected");
    assert_eq!(up.wi, Vec3::Z, "the four percent");
    let down = glass
        .sample(Vec3::Z, 0.0401, Vec2::ZERO)
        .expect("refracted");
    assert!(down.wi.distance(Vec3::NEG_Z) < 1e-6, "the rest");
    assert!(
        (down.weight.x * 2.25 - 1.0).abs() < 1e-5,
        "squeezed radiance"
    );
}

/// All that is reflected by a smooth coat on a smooth metal that absorbs nothing is what arrives:
/// the series of reflections inside of the coat loses none.
#[test]
fn a_coat_takes_nothing_away() {
    let smooth = Microfacets::new(Vec2::ZERO);
    let silver = Conductor {
        eta: Vec3::splat(1e-4),
        k: Vec3::splat(10.0),
        facets: smooth,
    };
    let coated = CoatedConductor::new(silver, 1.5, smooth);
    assert!(coated.is_dirac(), "two mirrors");
    for wo in viewers() {
        // Each layer is chosen with a probability; the two weights times these are shares.
        let [coat, metal] = [0.0, 1.0 - f32::EPSILON].map(|u_lobe| {
            let sample = coated
                .sample(wo, u_lobe, Vec2::splat(0.5))
                .expect("a mirror");
            assert!(sample.pdf.is_none(), "a Dirac");
            sample.weight.x
        });
        let share = fresnel::dielectric(wo.z.abs(), 1.5);
        let p = share / coat;
        let sum = share + metal * (1.0 - p);
        assert!((sum - 1.0).abs() < 1e-3, "from {wo}: {sum}");
    }
}

/// What a smooth coat on a matt base reflects is what comes out of it after any number of
/// reflections inside, each by the internal reflectance, here summed from inside; of a white base
/// all.
#[test]
fn a_coated_base_reflects_the_series_of_reflections_inside() {
    const STEPS: u16 = 50_000;
    let eta = 1.5;
    // Cosine-weighted means are means over the squared cosine.
    let steps = (0..STEPS).map(|i| (f32::from(i) + 0.5) / f32::from(STEPS));
    let inside = steps.map(|x| f64::from(fresnel::dielectric(-x.sqrt(), eta)));
    let inside = inside.sum::<f64>() / f64::from(STEPS);
    for reflectance in [1.0, 0.5, 0.1] {
        let smooth = Microfacets::new(Vec2::ZERO);
        let coated = CoatedDiffuse::new(Vec3::splat(reflectance), eta, smooth);
        for wo in viewers() {
            let n = 256;
            let values = grid(n).map(|u| {
                let wi = cosine_hemisphere::sample(u);
                let wi = wi.with_z(wi.z * wo.z.signum());
                f64::from(coated.eval(wo, wi).x / (wi.z.abs() * FRAC_1_PI))
            });
            let base = values.sum::<f64>() / f64::from(u32::from(n) * u32::from(n));
            let coat = f64::from(fresnel::dielectric(wo.z.abs(), eta));
            let white = f64::from(reflectance);
            let expected = (1.0 - coat) * white * (1.0 - inside) / (1.0 - white * inside);
            assert!(
                (base - expected).abs() < 1e-3,
                "{reflectance} from {wo}: {base}, not {expected}"
            );
        }
    }
}

/// A coat with the index of what is around it is none.
#[test]
fn a_coat_of_air_is_no_coat() {
    let gold = Conductor {
        eta: Vec3::new(0.143, 0.375, 1.442),
        k: Vec3::new(3.983, 2.386, 1.603),
        facets: Microfacets::new(Vec2::splat(0.3)),
    };
    let coated = CoatedConductor::new(gold, 1.0, Microfacets::new(Vec2::splat(0.3)));
    let (wo, wi) = (viewers()[0], Vec3::new(-0.3, 0.1, 0.9).normalize());
    let (expected, found) = (gold.eval(wo, wi), coated.eval(wo, wi));
    assert!(
        found.distance(expected) < 1e-4 * expected.length(),
        "{found}, not {expected}"
    );
}
