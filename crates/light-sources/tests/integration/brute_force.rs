//! Lights at random places against quadrature of their descriptions: few of the very many that
//! `cargo xtask brute-force` compares.

use light_testkit::brute_force::{Kind, check};

/// Compares the lights of the first `seeds` seeds.
fn check_all(kinds: impl IntoIterator<Item = Kind>, seeds: u64) {
    let faults: Vec<String> = kinds
        .into_iter()
        .flat_map(|kind| (0..seeds).filter_map(move |seed| check(kind, seed).err()))
        .collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn lights_on_shapes() {
    let kinds = [
        Kind::Triangle,
        Kind::Rectangle,
        Kind::Quad,
        Kind::Sphere,
        Kind::Disk,
        Kind::Cylinder,
    ];
    check_all(kinds, 96);
}

/// Of a sample at a low angle, the point is on its ray.
#[test]
fn a_rectangle_from_within_its_plane() {
    assert_eq!(check(Kind::Rectangle, 90036), Ok(()));
}

#[test]
fn meshes() {
    check_all([Kind::Mesh, Kind::PlacedMesh], 96);
}

#[test]
fn lights_at_points() {
    let kinds = [Kind::Point, Kind::Spot, Kind::Projection, Kind::Goniometric];
    check_all(kinds, 96);
}

#[test]
fn lights_at_infinity() {
    let kinds = [
        Kind::Distant,
        Kind::Sun,
        Kind::UniformInfinite,
        Kind::ImageInfinite,
        Kind::PortalInfinite,
    ];
    check_all(kinds, 32);
}

#[test]
fn skies_in_distant_lights() {
    check_all([Kind::MedianCut], 400);
}
