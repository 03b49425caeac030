use super::*;
use crate::Surface;
use lights::glam::Vec3Swizzles;

/// The square `[0, 1]^2` at height `z` as two triangles.
fn square(z: f32) -> [[Vec3; 3]; 2] {
    let [a, b, c, d] =
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec3::new(x, y, z));
    [[a, b, c], [a, c, d]]
}

fn two_squares() -> Accel {
    Accel::new(&[square(1.0), square(2.0)].concat())
}

fn down_z(x: f32, y: f32) -> Ray {
    Ray {
        origin: Vec3::new(x, y, 0.0),
        direction: Vec3::Z,
    }
}

#[test]
fn the_closest_hit_knows_its_triangle_and_place() {
    let hit = two_squares()
        .closest(&down_z(0.75, 0.25), None)
        .expect("a hit");
    assert_eq!(
        (hit.primitive, hit.t),
        (PrimitiveId::new(0), 1.0),
        "the first square"
    );
    let [a, b, c] = square(1.0)[0];
    let Vec2 { x, y } = hit.coords;
    let p = a * (1.0 - x - y) + b * x + c * y;
    assert!(
        p.distance(Vec3::new(0.75, 0.25, 1.0)) < 1e-6,
        "weights of the corners"
    );
}

#[test]
fn the_triangle_left_out_is_not_hit() {
    let hit = two_squares().closest(&down_z(0.75, 0.25), Some(PrimitiveId::new(0)));
    assert_eq!(
        hit.expect("a hit").primitive,
        PrimitiveId::new(2),
        "the one behind"
    );
}

#[test]
fn a_face_twice_in_one_plane_does_not_hide_itself() {
    for z in [0.0, 1e-3, 1.0, -300.0] {
        for swap in [0, 1, 2] {
            // Planes across every axis, with either winding.
            let turn = |[a, b, c]: [Vec3; 3]| [[a, b, c], [c, b, a]];
            let across = |v: Vec3| [v, v.yzx(), v.zxy()][swap];
            let once = square(z).map(|corners| corners.map(across));
            let accel = Accel::new(once.map(turn).as_flattened());
            let corners = once[0];
            let from = PrimitiveId::new(0);
            let surface = Surface::on_triangle(from, corners, Vec2::new(0.25, 0.5));
            for wi in [Vec3::new(1.0, 2.0, 3.0), Vec3::new(-3.0, -1.0, -2.0)] {
                let ray = surface.spawn(wi.normalize());
                let hit = accel.closest(&ray, Some(from));
                assert_eq!(hit, None, "at {z} across axis {swap}");
                assert!(!accel.occluded(&ray, 1.0, Some(from)), "{z}, {swap}");
            }
        }
    }
}

#[test]
fn occlusion_ends_at_its_limit() {
    let accel = two_squares();
    let ray = down_z(0.25, 0.75);
    assert!(accel.occluded(&ray, 1.5, None), "a square between");
    assert!(
        !accel.occluded(&ray, 0.5, None),
        "nothing before the square"
    );
    assert!(
        !accel.occluded(&ray, 1.5, Some(PrimitiveId::new(1))),
        "left out"
    );
    assert!(accel.closest(&down_z(1.5, 0.5), None).is_none(), "beside");
}

#[test]
fn an_empty_scene_is_missed() {
    let accel = Accel::new(&[]);
    assert!(
        accel.closest(&down_z(0.0, 0.0), None).is_none(),
        "nothing to hit"
    );
    assert!(
        !accel.occluded(&down_z(0.0, 0.0), 1.0, None),
        "nothing in the way"
    );
}

#[test]
fn no_ray_slips_through_the_edges_of_a_mesh() {
    // A fan of triangles around odd numbers: rays at shared edges and corners must hit something.
    let corner = |i: u32, j: u32| Vec3::new(i as f32 * 0.1 + 0.37, j as f32 * 0.1 - 12.3, 7.0);
    let triangles: Vec<_> = (0..64u32)
        .flat_map(|k| {
            let (i, j) = (k % 8, k / 8);
            let [a, b, c, d] = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let accel = Accel::new(&triangles);
    for k in 0..4096u32 {
        let [i, j] = [k % 64, k / 64].map(|n| (n as f32 + 0.5) / 64.0 * 0.7 + 0.05);
        let target = corner(0, 0) + Vec3::new(i, j, 0.0);
        let origin = Vec3::new(0.7, -11.9, 0.0);
        let ray = Ray {
            origin,
            direction: (target - origin).normalize(),
        };
        assert!(
            accel.closest(&ray, None).is_some(),
            "ray {k} towards {target}"
        );
    }
}
