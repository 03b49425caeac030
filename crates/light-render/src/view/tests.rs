use super::*;
use core::f32::consts::FRAC_PI_2;
use light_scene::{Lens, ScreenWindow};

fn camera() -> Camera {
    Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, FRAC_PI_2).expect("a plain camera")
}

#[test]
fn the_picture_is_upright_and_right_handed() {
    let view = View::new(&camera(), 200, 100).expect("a view");
    let at = |x, y| view.ray(Vec2::new(x, y), Vec2::ZERO).direction;
    assert!(at(100.0, 50.0).distance(Vec3::NEG_Z) < 1e-6, "the middle");
    let top = Vec3::new(0.0, 1.0, -1.0).normalize();
    assert!(
        at(100.0, 0.0).distance(top) < 1e-6,
        "the angle spans the shorter side"
    );
    let right = Vec3::new(2.0, 0.0, -1.0).normalize();
    assert!(
        at(200.0, 50.0).distance(right) < 1e-6,
        "+x is right when looking along -z"
    );
}

#[test]
fn a_lens_keeps_the_focal_plane_sharp() {
    let lens = Some(Lens {
        radius: 0.1,
        focus_distance: 3.0,
    });
    let blurred = View::new(&Camera { lens, ..camera() }, 200, 100).expect("a view");
    let film = Vec2::new(60.0, 20.0);
    let pinhole = View::new(&camera(), 200, 100)
        .expect("a view")
        .ray(film, Vec2::ZERO);
    let sharp = pinhole.at(3.0 / -pinhole.direction.z);
    for u in [Vec2::new(0.1, 0.9), Vec2::new(0.7, 0.3)] {
        let ray = blurred.ray(film, u);
        assert!(ray.origin != Vec3::ZERO, "starts on the lens");
        let p = ray.at((-3.0 - ray.origin.z) / ray.direction.z);
        assert!(p.distance(sharp) < 1e-5, "all rays meet in the focal plane");
    }
}

#[test]
fn windows_of_the_screen_move_and_stretch_the_picture() {
    let window = |x, y| {
        View::new(
            &Camera {
                screen: Some(ScreenWindow { x, y }),
                ..camera()
            },
            200,
            100,
        )
    };
    // At 90 degrees the screen at distance 1 shows its own lengths.
    let view = window([-1.0, 3.0], [0.5, 1.0]).expect("a view");
    let corner = |x, y| {
        let d = view.ray(Vec2::new(x, y), Vec2::ZERO).direction;
        Vec2::new(d.x, d.y) / -d.z
    };
    for (x, y, expected) in [
        (0.0, 0.0, Vec2::new(-1.0, 1.0)),
        (200.0, 100.0, Vec2::new(3.0, 0.5)),
        (50.0, 50.0, Vec2::new(0.0, 0.75)),
    ] {
        let found = corner(x, y);
        assert!(found.distance(expected) < 1e-5, "{found}, not {expected}");
    }
    let middle = window([-2.0, 2.0], [-1.0, 1.0]).expect("a view");
    let plain = View::new(&camera(), 200, 100).expect("a view");
    for film in [Vec2::new(3.0, 4.0), Vec2::new(150.0, 80.0)] {
        let [a, b] = [&middle, &plain].map(|view| view.ray(film, Vec2::ZERO).direction);
        assert!(a.distance(b) < 1e-6, "the window that there is without one");
    }
    let error = window([1.0, 1.0], [0.0, 1.0]).err();
    assert_eq!(error, Some(ViewError::Screen), "no width");
}

#[test]
fn orthographic_rays_are_parallel() {
    let camera = Camera {
        projection: Projection::Orthographic { scale: 3.0 },
        ..camera()
    };
    let view = View::new(&camera, 200, 100).expect("a view");
    let ray = view.ray(Vec2::new(200.0, 0.0), Vec2::ZERO);
    assert_eq!(ray.direction, Vec3::NEG_Z, "along the view");
    let expected = Vec3::new(6.0, 3.0, 0.0);
    assert!(
        ray.origin.distance(expected) < 1e-5,
        "from the screen: {}",
        ray.origin
    );
    let [fixed, grown] = view.pixel_width();
    assert!(
        (fixed - 0.06).abs() < 1e-6 && grown == 0.0,
        "the same at any distance"
    );
    let lens = Some(Lens {
        radius: 0.5,
        focus_distance: 2.0,
    });
    let blurred = View::new(&Camera { lens, ..camera }, 200, 100).expect("a view");
    let ray = blurred.ray(Vec2::new(200.0, 0.0), Vec2::new(0.3, 0.6));
    assert!(ray.origin.length() <= 0.5, "on the lens");
    let sharp = ray.at(-2.0 / ray.direction.z);
    assert!(
        sharp.distance(expected - Vec3::Z * 2.0) < 1e-5,
        "sharp: {sharp}"
    );
    let flat = Camera {
        projection: Projection::Orthographic { scale: 0.0 },
        ..camera
    };
    assert_eq!(View::new(&flat, 2, 2), Err(ViewError::Screen), "no size");
}

/// [`PBRT4`], `cameras.cpp`: the left edge of rows of latitude looks along x, a quarter further
/// along z; the middle of a square of equal areas looks along its pole, here up.
#[test]
fn spherical_pictures_show_all_around() {
    let look = |projection, x, y| {
        let camera = Camera {
            projection,
            ..camera()
        };
        let view = View::new(&camera, 400, 200).expect("a view");
        view.ray(Vec2::new(x, y), Vec2::ZERO).direction
    };
    for (projection, x, y, expected) in [
        (Projection::LatLong, 0.0, 100.0, Vec3::X),
        (Projection::LatLong, 100.0, 100.0, Vec3::NEG_Z),
        (Projection::LatLong, 300.0, 100.0, Vec3::Z),
        (Projection::LatLong, 123.0, 0.0, Vec3::Y),
        (Projection::LatLong, 123.0, 200.0, Vec3::NEG_Y),
        (Projection::EqualArea, 200.0, 100.0, Vec3::Y),
        (Projection::EqualArea, 0.0, 0.0, Vec3::NEG_Y),
        (Projection::EqualArea, 400.0, 100.0, Vec3::X),
        (Projection::EqualArea, 200.0, 200.0, Vec3::NEG_Z),
    ] {
        let found = look(projection, x, y);
        assert!(
            found.distance(expected) < 1e-5,
            "{projection:?} {x} {y}: {found}"
        );
    }
}

#[test]
fn bad_views_are_named() {
    let error = |camera: Camera, width| View::new(&camera, width, 1).err();
    let lens = |radius, focus_distance| {
        Some(Lens {
            radius,
            focus_distance,
        })
    };
    assert_eq!(
        error(camera(), 0),
        Some(ViewError::EmptyPicture),
        "no pixel"
    );
    assert_eq!(
        View::new(&camera(), u32::MAX, 2),
        Err(ViewError::HugePicture),
        "huge"
    );
    let position = Vec3::NAN;
    assert_eq!(
        error(
            Camera {
                position,
                ..camera()
            },
            1
        ),
        Some(ViewError::Axes),
        "NaN"
    );
    for fov in [0.0, 4.0, f32::NAN] {
        let bad = Camera { fov, ..camera() };
        assert_eq!(error(bad, 1), Some(ViewError::FieldOfView), "{fov}");
    }
    for lens in [lens(-1.0, 1.0), lens(1.0, 0.0), lens(f32::NAN, 1.0)] {
        let bad = Camera { lens, ..camera() };
        assert_eq!(error(bad, 1), Some(ViewError::Lens), "{lens:?}");
    }
}
