use lights::sources::shape::Shape;

use super::*;

/// A turn, a scale by 2 and a way.
fn similarity() -> Affine3A {
    let turn = Affine3A::from_axis_angle(Vec3::new(1.0, 2.0, 2.0) / 3.0, 0.8);
    let scale = Affine3A::from_scale(Vec3::splat(2.0));
    Affine3A::from_translation(Vec3::new(5.0, 0.0, -1.0)) * turn * scale
}

fn all() -> [Quadric; 4] {
    [
        QuadricKind::Sphere,
        QuadricKind::Disk { inner_radius: 0.0 },
        QuadricKind::Disk { inner_radius: 0.6 },
        QuadricKind::Cylinder { length: 3.0 },
    ]
    .map(|kind| Quadric::new("round", MaterialId(0), kind, similarity()))
}

fn sphere() -> Quadric {
    Quadric::sphere("ball", MaterialId(0), similarity())
}

#[test]
fn it_is_where_its_triangles_are() {
    for quadric in all() {
        let kind = quadric.kind;
        assert!((quadric.radius() - 2.0).abs() < 1e-6, "scaled");
        let mesh = quadric.mesh(256);
        let inverse = quadric.transform.inverse();
        for p in &mesh.positions {
            let local = inverse.transform_point3(*p);
            let across = local.truncate().length();
            let off = match kind {
                QuadricKind::Sphere => local.length() - 1.0,
                QuadricKind::Disk { inner_radius } => {
                    (across - 1.0).abs().min((across - inner_radius).abs()) + local.z.abs()
                }
                QuadricKind::Cylinder { length } => {
                    (across - 1.0).abs() + (local.z.abs() - 0.5 * length).abs()
                }
            };
            assert!(off.abs() < 1e-5, "{kind:?}: {p} lies on it");
        }
        assert!(
            (mesh.area() / quadric.area() - 1.0).abs() < 1e-3,
            "{kind:?}: {} and {}",
            mesh.area(),
            quadric.area()
        );
        let (bounds, exact) = (mesh.bounds(), quadric.bounds());
        let off = (bounds.min - exact.min).abs() + (bounds.max - exact.max).abs();
        assert!(
            off.max_element() < 1e-2,
            "{kind:?}: {bounds:?} and {exact:?}"
        );
        let built = quadric.shape().build().expect("a shape");
        let area = built.area();
        assert!(
            (area / quadric.area() - 1.0).abs() < 1e-6,
            "{kind:?}: {area}"
        );
    }
}

#[test]
fn only_similarities_keep_a_sphere_a_sphere() {
    let sphere = sphere();
    let mirrored = Affine3A::from_scale(Vec3::new(3.0, 3.0, -3.0));
    let moved = sphere.transformed(&mirrored).expect("a sphere");
    assert!((moved.radius() - 6.0).abs() < 1e-5, "three times as large");
    assert_eq!(moved.center(), Vec3::new(15.0, 0.0, 3.0), "mirrored");
    let squeezed = Affine3A::from_scale(Vec3::new(1.0, 1.01, 1.0));
    let flat = Affine3A::from_scale(Vec3::ZERO);
    let nowhere = Affine3A::from_translation(Vec3::NAN);
    for quadric in all() {
        for bad in [squeezed, flat, nowhere] {
            assert_eq!(quadric.transformed(&bad), None, "{bad}");
        }
    }
}

#[test]
fn disks_and_cylinders_may_be_stretched_along_their_axis() {
    let stretch = Affine3A::from_scale(Vec3::new(2.0, 2.0, 6.0));
    let unit = |kind| Quadric::new("round", MaterialId(0), kind, Affine3A::IDENTITY);
    let tube = unit(QuadricKind::Cylinder { length: 1.5 });
    let tube = tube.transformed(&stretch).expect("a longer tube");
    assert_eq!(tube.kind, QuadricKind::Cylinder { length: 4.5 });
    assert_eq!(tube.bounds().max, Vec3::new(2.0, 2.0, 4.5));
    // Sheared along x, and turned over.
    let mut shear = stretch;
    shear.matrix3.z_axis.x = 5.0;
    shear.matrix3.z_axis.z = -1.0;
    let disk = unit(QuadricKind::Disk { inner_radius: 0.5 });
    let disk = disk.transformed(&shear).expect("a disk");
    assert_eq!(
        disk.transform.matrix3.z_axis,
        Vec3::new(0.0, 0.0, -2.0).into()
    );
    assert_eq!(disk.bounds().max, Vec3::new(2.0, 2.0, 0.0));
    assert_eq!(
        tube.transformed(&shear),
        None,
        "a tube that leans is another shape"
    );
}

#[test]
fn its_triangles_have_its_front() {
    for quadric in all() {
        for mirror in [1.0, -1.0] {
            let transform = Affine3A::from_scale(Vec3::new(mirror, 1.0, 1.0));
            let quadric = quadric.transformed(&transform).expect("the same shape");
            for (front, sign) in [(QuadricFront::Outside, 1.0), (QuadricFront::Inside, -1.0)] {
                let axis = Vec3::from(quadric.transform.matrix3.z_axis);
                let center = quadric.center();
                let mesh = Quadric {
                    front,
                    ..quadric.clone()
                }
                .mesh(16);
                for index in 0..mesh.indices.len() {
                    let [a, b, c] = mesh.triangle(index);
                    let normal = (b - a).cross(c - a) * sign;
                    let outward = match quadric.kind {
                        QuadricKind::Sphere => a + b + c - center * 3.0,
                        QuadricKind::Disk { .. } => axis,
                        QuadricKind::Cylinder { .. } => {
                            (a + b + c - center * 3.0).reject_from(axis)
                        }
                    };
                    assert!(
                        normal.dot(outward) > 0.0,
                        "{:?}, {front:?}, {mirror}",
                        quadric.kind
                    );
                }
            }
        }
    }
}
