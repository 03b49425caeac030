use super::*;
use crate::amount::RadianceAmount;
use crate::diffuse_emission_desc::SurfaceColor;
use crate::light::Light;
use crate::rgb::Rgb;

fn square() -> MeshLightDesc<Rgb> {
    MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y].into(),
        indices: [[0, 1, 2], [0, 2, 3]].into(),
        uvs: None,
        emission: DiffuseEmissionDesc::new(
            SurfaceColor::Uniform(Vec3::ONE),
            RadianceAmount::Radiometric(1.0),
        ),
    }
}

#[test]
fn a_triangle_without_area_is_a_light_without_power_and_with_valid_bounds() {
    let mesh = MeshLight::new(MeshLightDesc {
        indices: [[0, 1, 2], [0, 1, 1]].into(),
        ..square()
    })
    .expect("a mesh");
    let extent = mesh.triangle(1).expect("the flat one").extent();
    let bounds = extent.bounded().expect("somewhere");
    assert_eq!(
        (bounds.phi, bounds.validate()),
        (0.0, Ok(())),
        "no light, no nonsense"
    );
}

#[test]
fn refuses_nonsense_by_field() {
    let error = |desc| MeshLight::new(desc).err();
    assert_eq!(error(square()), None, "a square");
    let desc = MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::NAN, Vec3::Y].into(),
        ..square()
    };
    assert_eq!(
        error(desc),
        Some(MeshLightError::Position { vertex: 2 }),
        "NaN"
    );
    let desc = MeshLightDesc {
        indices: [[0, 1, 2], [0, 2, 4]].into(),
        ..square()
    };
    assert_eq!(
        error(desc),
        Some(MeshLightError::Index { triangle: 1 }),
        "index"
    );
    let desc = MeshLightDesc {
        positions: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X * 1e20, Vec3::Y * 1e20].into(),
        indices: [[0, 1, 2], [0, 3, 4]].into(),
        ..square()
    };
    assert_eq!(
        error(desc),
        Some(MeshLightError::Area { triangle: 1 }),
        "too large"
    );
    let desc = MeshLightDesc {
        indices: MeshIndices::Consecutive(2),
        ..square()
    };
    assert_eq!(
        error(desc),
        Some(MeshLightError::Index { triangle: 1 }),
        "six vertices"
    );
    let desc = MeshLightDesc {
        uvs: Some([Vec2::ZERO].into()),
        ..square()
    };
    assert_eq!(error(desc), Some(MeshLightError::UvCount), "too few");
    let desc = MeshLightDesc {
        uvs: Some([Vec2::NAN; 4].into()),
        ..square()
    };
    assert_eq!(error(desc), Some(MeshLightError::Uv { vertex: 0 }), "NaN");
}

#[test]
fn triangles_beyond_the_last_are_none() {
    let Ok(mesh) = MeshLight::new(square()) else {
        unreachable!("a square")
    };
    assert_eq!(mesh.len(), 2, "two");
    assert!(
        mesh.triangle(1).is_some() && mesh.triangle(2).is_none(),
        "no third"
    );
}
