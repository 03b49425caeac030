//! Shapes whose areas have squares below the smallest float, and receivers so near that rounding
//! turns directions.

use light_sources::glam::{Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::shape::{
    AnyShape, BilinearPatch, BilinearPatchError, Rectangle, Shape, Triangle, TriangleError,
};
use light_sources::{
    Channels, DiffuseEmission, DiffuseEmissionDesc, Image, RadianceAmount, Rgb, SurfaceColor,
    Texture,
};

#[test]
fn samples_of_a_tiny_triangle_have_its_normal_and_area() {
    for size in [1e-10f32, 2e-11, 3e-16, 1e-18, 1e-19] {
        let corners = [Vec3::ZERO, Vec3::X * size, Vec3::new(0.3, 0.4, 0.5) * size];
        let triangle = Triangle::new(corners, Triangle::DEFAULT_UV).expect("an area");
        let sample = triangle.sample(Vec2::splat(0.3)).expect("a sample");
        let n = sample.at.n;
        assert!((n.length() - 1.0).abs() < 1e-5, "size {size}: {n}");
        let exact = 0.5 * f64::from(size).powi(2) * 0.41f64.sqrt();
        for pdf in [sample.pdf, triangle.pdf(&sample.at)] {
            assert!((f64::from(pdf) * exact - 1.0).abs() < 1e-5, "{size}: {pdf}");
        }
    }
    let corners = [Vec3::ZERO, Vec3::X * 1e-20, Vec3::Y * 1e-20];
    let refused = Triangle::new(corners, Triangle::DEFAULT_UV);
    assert_eq!(refused, Err(TriangleError::Area), "1e-40");
}

/// A small surface far from the origin, so near to the receiver that the rounding of its places
/// turns directions: a sample is the place that its direction meets, with the density of a query.
#[test]
fn small_surfaces_far_from_the_origin() {
    let far = Vec3::new(1000.0, 700.0, -900.0);
    let edges = [Vec3::X * 0.004, Vec3::Y * 0.004];
    let rectangle = Rectangle::new(far, edges).expect("an area");
    let corners = [far, far + edges[0], far + edges[1]];
    let triangle = Triangle::new(corners, Triangle::DEFAULT_UV).expect("an area");
    let shapes: [AnyShape; 2] = [AnyShape::Rectangle(rectangle), AnyShape::Triangle(triangle)];
    for shape in shapes {
        let mut found = 0;
        for i in 0..100u8 {
            let u = Vec2::new(f32::from(i % 10) + 0.5, f32::from(i / 10) + 0.5) / 10.0;
            let to = Vec3::new(0.1, f32::from(i) * 0.003, 0.6);
            let ctx = LightSampleContext::medium(far + to);
            let Some(sample) = shape.sample_toward(&ctx, u) else {
                continue;
            };
            let pdf = shape.pdf_toward(&ctx, sample.wi);
            assert_eq!(sample.pdf, pdf, "{sample:?} of {shape:?}");
            found += 1;
        }
        assert!(found > 50, "most directions meet {shape:?}: {found}");
    }
}

/// However small, a patch shows as much of its image as a large one: the squares of its areas are
/// below the smallest float.
#[test]
fn a_tiny_patch_has_the_mean_of_its_image() {
    let texels = [1.0, 0.0, 0.25, 0.5].map(|x| [x; 3]);
    let image = Image::from_f32([2, 2], Channels::Rgb, texels.as_flattened());
    let texture = Texture::new(image.expect("an image"));
    let color = SurfaceColor::Image {
        texture,
        tint: Vec3::ONE,
    };
    let desc = DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(1.0));
    let emission = DiffuseEmission::<Rgb>::new(desc, [] as [AnyShape; 0]).expect("an emission");
    let mean = |size: f32| {
        let corners = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 1.0, 0.5],
        ];
        let patch = BilinearPatch::new(corners.map(|p| Vec3::from(p) * size)).expect("an area");
        f64::from(emission.phi(&patch, &()).x) / f64::from(patch.area())
    };
    let large = mean(1.0);
    assert!(large > 0.1, "{large}");
    for size in [1e-9, 1e-10, 3e-12, 1e-13, 1e-15] {
        let found = mean(size);
        assert!(
            (found / large - 1.0).abs() < 1e-5,
            "{size}: {found}, {large}"
        );
    }
}

#[test]
fn samples_next_to_a_vertex_are_found_again() {
    let corners = [
        Vec3::new(0.0, 5.125, -4.875),
        Vec3::new(-4.875, 5.6875, 2.625),
        Vec3::splat(-2.0),
    ];
    let triangle = Triangle::new(corners, Triangle::DEFAULT_UV).expect("an area");
    let ctx = LightSampleContext::medium(corners[2]);
    let mut missed = 0;
    for i in 0..1000u16 {
        let u = Vec2::new(f32::from(i % 10) * 0.1, f32::from(i) * 4e-9);
        let Some(sample) = triangle.sample_toward(&ctx, u) else {
            missed += 1;
            continue;
        };
        if sample.at.n.dot(sample.wi).abs() < 1e-3 {
            continue;
        }
        assert_eq!(
            triangle.pdf_toward(&ctx, sample.wi),
            sample.pdf,
            "{sample:?}"
        );
    }
    assert!(
        missed > 0,
        "in the plane of the triangle there is nothing to see"
    );
}

#[test]
fn a_narrow_patch_has_its_normal_and_area() {
    for width in [1e-3f32, 1e-20, 1e-26, 1e-30] {
        let (x, y) = (Vec3::X * width, Vec3::new(0.0, 0.6, 0.8) * 1e5);
        let patch = BilinearPatch::new([Vec3::ZERO, x, y, x + y]).expect("an area");
        let sample = patch.sample(Vec2::new(0.3, 0.4)).expect("a sample");
        let n = sample.at.n;
        let off = n.distance(Vec3::new(0.0, -0.8, 0.6));
        assert!(off < 1e-5, "width {width}: {n}");
        let area = f64::from(width) * 1e5;
        for pdf in [sample.pdf, patch.pdf(&sample.at), 1.0 / patch.area()] {
            assert!((f64::from(pdf) * area - 1.0).abs() < 1e-5, "{width}: {pdf}");
        }
    }
    let [x, y] = [Vec3::X, Vec3::Y].map(|v| v * 1e-20);
    let refused = BilinearPatch::new([Vec3::ZERO, x, y, x + y]);
    assert_eq!(refused, Err(BilinearPatchError::Area), "1e-40");
}

#[test]
fn samples_of_a_rectangle_next_to_its_corner_are_found_again() {
    let corner = Vec3::new(-2.0, 3.0, 5.0);
    let edges = [Vec3::new(0.9, 1.2, 0.0), Vec3::new(0.8, -0.6, 2.0)];
    let rectangle = Rectangle::new(corner, edges).expect("a rectangle");
    let ctx = LightSampleContext::medium(corner);
    let mut missed = 0;
    for i in 0..1000u16 {
        let u = Vec2::new(f32::from(i % 32), f32::from(i / 32)) * 3e-7;
        let Some(sample) = rectangle.sample_toward(&ctx, u) else {
            missed += 1;
            continue;
        };
        if sample.at.n.dot(sample.wi).abs() >= 1e-3 {
            let pdf = rectangle.pdf_toward(&ctx, sample.wi);
            assert_eq!(pdf, sample.pdf, "{sample:?}");
        }
    }
    assert!(missed > 0, "there is nothing to see in its plane");
}

/// Both sides leave the first corner in one direction: there is no normal.
#[test]
fn samples_at_a_corner_without_area_are_found_again() {
    let patches = [
        (
            [2.3125, -2.375, -2.375],
            [-2.375, -2.375, -2.375],
            [2.375, 7.625, 2.375],
        ),
        ([0.0, 0.0, 0.0], [1.0, 0.5, 0.25], [-0.5, 1.0, 0.5]),
        ([1.0, 2.0, 3.0], [-0.4, 0.7, 0.1], [3.0, 1.0, -2.0]),
    ];
    let mut compared = 0;
    for (p00, side, bend) in patches {
        let [p00, side, bend] = [p00, side, bend].map(Vec3::from_array);
        let corners = [p00, p00 + side, p00 + side, p00 + 2.0 * side + bend];
        let patch = BilinearPatch::new(corners).expect("an area");
        for i in 0..1000u16 {
            let scale = [1e-8, 1e-7, 1e-6][usize::from(i % 3)];
            let u = Vec2::new(f32::from(i % 8), f32::from(i / 8 % 8)) * scale;
            let around = Vec3::new(f32::from(i % 13), f32::from(i % 17), f32::from(i % 7));
            let ctx = LightSampleContext::medium(p00 + around - Vec3::new(6.0, 8.0, 3.0));
            let Some(sample) = patch.sample_toward(&ctx, u) else {
                continue;
            };
            compared += 1;
            let pdf = patch.pdf_toward(&ctx, sample.wi);
            let cos_theta = sample.at.n.dot(sample.wi).abs();
            assert!(
                (pdf - sample.pdf).abs() <= 5e-3 * pdf || cos_theta < 0.1,
                "queried {pdf}, {sample:?} for {u} from {}",
                ctx.p
            );
        }
    }
    assert!(compared > 100, "{compared} compared");
}

/// A flat patch with a corner pushed in covers some directions twice; a ray meets one place.
#[test]
fn a_patch_that_folds_over_itself_is_sampled_where_a_ray_meets_it() {
    let corners = [
        [0.125, 0.0],
        [0.125, -5.375],
        [-5.125, 4.3125],
        [0.1875, 6.375],
    ];
    let corners = corners.map(|[y, z]| Vec3::new(6.5, y, z));
    let patch = BilinearPatch::new(corners).expect("an area");
    let ctx = LightSampleContext::medium(Vec3::new(-0.625, -0.0625, 0.0));
    let (mut kept, mut other) = (0, 0);
    for i in 0..1024u16 {
        let u = Vec2::new(f32::from(i % 32), f32::from(i / 32)) / 32.0;
        let Some(sample) = patch.sample_toward(&ctx, u) else {
            other += 1;
            continue;
        };
        kept += 1;
        let pdf = patch.pdf_toward(&ctx, sample.wi);
        assert!(
            (pdf - sample.pdf).abs() <= 2e-3 * pdf,
            "queried {pdf}, {sample:?}"
        );
    }
    assert!(
        kept > 500 && other > 10,
        "{kept} kept, {other} on the other side"
    );
}

/// A ribbon turned by half: the normals at two of its corners are nearly opposite to the others.
#[test]
fn opposite_normals_have_no_cone() {
    let z = 4.8e-4;
    let corners = [
        Vec3::NEG_X,
        Vec3::X,
        Vec3::new(1.0, 1.0, z),
        Vec3::new(-1.0, 1.0, -z),
    ];
    let patch = BilinearPatch::new(corners).expect("an area");
    let cone = patch.normal_cone();
    assert!(cone.is_whole_sphere(), "{cone:?}");
    assert!((cone.w.length() - 1.0).abs() < 1e-6, "{cone:?}");
}

/// The sides cross, but for subnormal numbers in the normals.
#[test]
fn a_flat_quad_whose_sides_cross_is_refused() {
    let corners = [
        Vec3::ZERO,
        Vec3::splat(53.0),
        Vec3::new(53.0, 0.0, 1.081_694_3e-19),
        Vec3::new(2.449_22, 53.0, 53.0),
    ];
    let error = BilinearPatch::new(corners).err();
    assert_eq!(error, Some(BilinearPatchError::Crossed));
}

/// One of the two triangles is a sliver, whose density is not that of the other.
#[test]
fn samples_at_the_diagonal_of_a_flat_quad_have_the_queried_density() {
    let corners = [
        Vec3::splat(-0.0625),
        Vec3::splat(-0.125),
        Vec3::new(-0.125, -0.125, 6.4375),
        Vec3::new(-5.4375, -5.4375, -1.5625),
    ];
    let patch = BilinearPatch::new(corners).expect("an area");
    let ctx = LightSampleContext::medium(Vec3::new(5.625, 6.375, 2.0625));
    let mut taken = 0;
    for i in 0..1024u16 {
        let u = Vec2::new(f32::from(i % 32), f32::from(i / 32)) / 32.0;
        let Some(sample) = patch.sample_toward(&ctx, u) else {
            continue;
        };
        taken += 1;
        let pdf = patch.pdf_toward(&ctx, sample.wi);
        assert_eq!(pdf, sample.pdf, "for {u}");
    }
    assert!(taken > 900, "{taken} of 1,024");
}

/// A power below the smallest float must not hide a light from samplers.
#[test]
fn a_faint_surface_has_a_power() {
    let corners = [Vec3::ZERO, Vec3::X * 1e-18, Vec3::Y * 1e-18];
    let triangle = Triangle::new(corners, Triangle::DEFAULT_UV).expect("an area");
    for (radiance, expected) in [(1e-10, f32::MIN_POSITIVE), (0.0, 0.0)] {
        let color = SurfaceColor::Uniform(Vec3::ONE);
        let desc = DiffuseEmissionDesc::new(color, RadianceAmount::Radiometric(radiance));
        let emission = DiffuseEmission::<Rgb>::new(desc, [triangle]).expect("an emission");
        assert_eq!(emission.strength(&triangle), expected, "{radiance}");
    }
}
