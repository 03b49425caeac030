use super::*;
use crate::amount::{IntensityAmount, IrradianceAmount, RadianceAmount};
use crate::diffuse_emission_desc::{DiffuseEmissionDesc, SurfaceColor};
use crate::distant::DistantLightDesc;
use crate::glam::Vec3;
use crate::light::Light;
use crate::light_desc::LightDesc;
use crate::light_set_builder::LightSetBuilder;
use crate::light_type::LightType;
use crate::medium_interface::MediumInterface;
use crate::mesh::MeshLightDesc;
use crate::point::PointLightDesc;
use crate::rgb::Rgb;
use crate::scene_sphere::SceneSphere;
use crate::spectral::Spectral;
use crate::spectral_emission::SpectralEmission;
use alloc::sync::Arc;
use light_math::spectrum::photometric::{Lumen, Watt};
use light_math::spectrum::{Blackbody, PiecewiseLinear};

fn point(intensity: f32) -> LightDesc<Rgb> {
    LightDesc::Point(PointLightDesc {
        position: Vec3::ZERO,
        emission: Vec3::ONE,
        amount: IntensityAmount::Radiometric(intensity),
        media: MediumInterface::default(),
    })
}

fn sun() -> LightDesc<Rgb> {
    LightDesc::Distant(DistantLightDesc {
        direction: Vec3::Z,
        emission: Vec3::ONE,
        amount: IrradianceAmount::Radiometric(1.0),
    })
}

/// `triangles` right-angled triangles of area 0.5 that lie in the plane z = 1.
fn mesh(triangles: usize, radiance: f32) -> LightDesc<Rgb> {
    LightDesc::Mesh(MeshLightDesc {
        positions: [Vec3::Z, Vec3::Z + Vec3::X, Vec3::Z + Vec3::Y].into(),
        indices: alloc::vec![[0, 1, 2]; triangles].into(),
        uvs: None,
        emission: DiffuseEmissionDesc::new(
            SurfaceColor::Uniform(Vec3::ONE),
            RadianceAmount::Radiometric(radiance),
        ),
    })
}

fn set(descs: &[LightDesc<Rgb>]) -> (LightSet<Rgb>, Vec<SourceId>) {
    let Ok(scene) = SceneSphere::new(Vec3::ZERO, 2.0) else {
        unreachable!("a sphere")
    };
    let mut builder = LightSetBuilder::new(scene);
    let sources = descs
        .iter()
        .filter_map(|desc| builder.add(desc.clone()).ok());
    let sources = sources.collect();
    (builder.build(), sources)
}

#[test]
fn every_triangle_is_found_in_its_mesh() {
    let counts = [1, 0, 0, 200, 1, 1, 63, 64, 0, 65, 1, 500, 0, 0];
    let radiance = |mesh: usize| (mesh + 1) as f32;
    let descs: Vec<_> = (0..)
        .zip(counts)
        .map(|(m, n)| mesh(n, radiance(m)))
        .collect();
    let (set, sources) = set(&descs);
    assert_eq!(set.len(), counts.iter().sum::<usize>(), "all");
    for (m, (count, source)) in counts.into_iter().zip(sources).enumerate() {
        let Some(LightId(first)) = set.first_id(source) else {
            panic!("no id for mesh {m}");
        };
        for id in (first..).take(count) {
            let Some(LightRef::Triangle(light)) = set.get(LightId(id)) else {
                panic!("no triangle {id}");
            };
            let phi = light.phi(&());
            let expected = core::f32::consts::PI * 0.5 * radiance(m);
            assert!(
                (phi.x - expected).abs() < 1e-4 * expected,
                "{phi} of {id} in {m}"
            );
        }
    }
}

#[test]
fn corners_are_known_beforehand_where_they_follow_each_other() {
    let soup = |triangles: u32| {
        let vertex = |k: u32| Vec3::new(k as f32, (k % 3) as f32, (k % 2) as f32);
        LightDesc::Mesh(MeshLightDesc {
            positions: (0..3 * triangles).map(vertex).collect(),
            indices: crate::MeshIndices::Consecutive(triangles),
            uvs: None,
            emission: DiffuseEmissionDesc::new(
                SurfaceColor::Uniform(Vec3::ONE),
                RadianceAmount::Radiometric(1.0),
            ),
        })
    };
    let (set, _) = set(&[point(1.0), soup(70), mesh(3, 1.0), soup(9), sun()]);
    let mut known = 0;
    for (id, light) in set.iter() {
        let Some(corners) = set.corners(id) else {
            continue;
        };
        known += 1;
        let LightRef::Triangle(light) = light else {
            panic!("{id:?} is no triangle");
        };
        assert_eq!(light.shape().vertices(), *corners, "those of {id:?}");
    }
    assert_eq!(known, 79, "all but those by a list");
    assert_eq!(set.corners(LightId(u32::MAX)), None, "unknown");
}

#[test]
fn ids_are_in_the_order_of_adding_and_sources_know_theirs() {
    let (set, sources) = set(&[
        sun(),
        mesh(2, 1.0),
        point(1.0),
        mesh(0, 1.0),
        mesh(3, 2.0),
        point(2.0),
    ]);
    let firsts: Vec<_> = sources.iter().filter_map(|&s| set.first_id(s)).collect();
    assert_eq!(
        firsts,
        [0, 1, 3, 4, 4, 7].map(LightId),
        "in the order of adding"
    );
    assert_eq!(set.len(), 8, "all");
    assert!(set.infinite_ids().eq([LightId(0)]), "the sun");
    let types: Vec<_> = set.iter().map(|(_, light)| light.light_type()).collect();
    let area = LightType::Area;
    let (position, direction) = (LightType::DeltaPosition, LightType::DeltaDirection);
    assert_eq!(
        types,
        [direction, area, area, position, area, area, area, position],
        "kinds"
    );
    assert!(set.get(LightId(8)).is_none(), "unknown");
    assert!(set.first_id(SourceId(6)).is_none(), "unknown");
    assert_eq!(set.id_of(SourceId(6), 0), None, "unknown");
    assert_eq!(set.source_of(LightId(8)), None, "unknown");
}

#[test]
fn triangles_and_their_sources_lead_to_each_other() {
    // Blocks of the search table begin in a mesh, between meshes, and among single lights.
    let counts = [1, 0, 130, 0, 0, 1, 1, 62, 64, 1, 0, 300, 0];
    let descs = counts.map(|count| {
        if count == 1 {
            point(1.0)
        } else {
            mesh(count, 1.0)
        }
    });
    let (mut set, sources) = set(&[&descs[..], &alloc::vec![sun(); 200]].concat());
    let mut next = 0;
    for (&source, count) in sources.iter().zip(counts.into_iter().chain([1; 200])) {
        let count = u32::try_from(count).expect("small");
        for triangle in 0..count {
            assert_eq!(
                set.id_of(source, triangle),
                Some(LightId(next)),
                "{source:?}"
            );
            assert_eq!(
                set.source_of(LightId(next)),
                Some((source, triangle)),
                "{next}"
            );
            next += 1;
        }
        assert_eq!(
            set.id_of(source, count),
            None,
            "behind the last of {source:?}"
        );
    }
    assert_eq!(set.len(), next as usize, "all");
    let before = set.clone();
    let added = LightSource::new(mesh(2, 1.0), set.scene).and_then(|source| set.push(source));
    let added = added.expect("one more");
    assert_eq!(set.first_id(added), Some(LightId(next)), "at the end");
    for source in sources {
        assert_eq!(set.first_id(source), before.first_id(source), "as before");
    }
}

#[test]
fn powers_and_extents_are_those_of_the_lights() {
    let (set, _) = set(&[point(1.0), mesh(1, 3.0), sun()]);
    let powers = set.powers();
    let expected = [4.0, 1.5, 4.0].map(|x| x * core::f32::consts::PI);
    for (power, expected) in powers.iter().zip(expected) {
        assert!(
            (power - expected).abs() < 1e-5,
            "{power}, expected {expected}"
        );
    }
    let extents = set.extents();
    assert_eq!(extents.len(), 3, "one each");
    assert!(
        extents.iter().all(|extent| match extent {
            LightExtent::Bounded(bounds) | LightExtent::Lobe(bounds, _) =>
                bounds.validate().is_ok(),
            LightExtent::Infinite(bounds) => bounds.validate().is_ok(),
        }),
        "valid"
    );
}

/// A lamp of one narrow line has the power that it was asked for, in watts or lumens.
#[test]
fn powers_of_spectral_lights_are_integrals() {
    type S4 = Spectral<4>;
    let line = |middle: f32, half: f32| {
        let lambda = Arc::from([middle - half, middle, middle + half].as_slice());
        let line =
            PiecewiseLinear::<Arc<[f32]>>::new(lambda, Arc::from([0.0, 1.0, 0.0].as_slice()));
        SpectralEmission::from(line.expect("a line"))
    };
    let bulb = SpectralEmission::from(Blackbody::new(2700.0).expect("valid"));
    let lamp = |emission, amount| PointLightDesc::<S4>::new(Vec3::ZERO, emission, amount);
    let watts = IntensityAmount::RadiantPower(Watt(9.0));
    let scene = SceneSphere::new(Vec3::ZERO, 2.0).expect("a sphere");
    let mut builder = LightSetBuilder::<S4>::new(scene);
    for half in [0.5, 1.0, 2.0, 5.0, 20.0] {
        builder.add(lamp(line(589.0, half), watts)).expect("a lamp");
    }
    builder.add(lamp(bulb, watts)).expect("a bulb");
    let powers = builder.build().powers();
    for power in powers {
        assert!((power / 9.0 - 1.0).abs() < 1e-5, "{power} W");
    }
    let laser = |lambda: f32, half: f32| {
        let lumens = IntensityAmount::LuminousPower(Lumen(683.0));
        lamp(line(lambda, half), lumens)
    };
    let dark = lamp(line(589.0, 0.5), IntensityAmount::Radiometric(0.0));
    let mut builder = LightSetBuilder::<S4>::new(scene);
    for lambda in [555.0, 554.5] {
        builder.add(laser(lambda, 0.1)).expect("a laser");
    }
    builder.add(dark).expect("a dark lamp");
    let powers = builder.build().powers();
    for power in &powers[..2] {
        assert!((power - 1.0).abs() < 2e-3, "{power} W");
    }
    assert_eq!(powers[2], 0.0, "dark");
}
