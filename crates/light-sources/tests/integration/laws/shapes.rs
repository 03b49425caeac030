use light_sources::glam::Vec3;
use light_sources::light_bounds::LightSampleContext;
use light_sources::light_math::warp::uniform_triangle;
use light_sources::shape::{AnyShape, BilinearPatch, Shape, ShapeDesc};
use light_sources::*;
use light_testkit::laws::light::*;
use light_testkit::{Estimate, Rng, naive};

use super::shape_geometry::{barycentric, box_around, cap_around, hit_quad, local, tilted, turn};

#[test]
fn triangle() {
    let corners = [
        Vec3::ZERO,
        Vec3::new(2.0, 0.0, 0.3),
        Vec3::new(0.4, 1.5, 0.0),
    ];
    let hit = |p, wi| naive::hit_triangle(p, wi, corners);
    let place = |p: Vec3| {
        let u = uniform_triangle::invert(barycentric(p, corners));
        u.to_array().map(f64::from)
    };
    check(ShapeDesc::Triangle(corners), &corners, hit, Some(&place));
}

#[test]
fn rectangle() {
    let (x, y) = (Vec3::new(1.0, 0.5, 0.0), Vec3::new(-0.5, 1.0, 0.3));
    let corners = [Vec3::ZERO, x, x + y, y].map(|p| p + Vec3::ONE);
    let desc = ShapeDesc::Rectangle {
        corner: Vec3::ONE,
        edges: [x, y],
    };
    let place = |p: Vec3| {
        let along = |edge: Vec3| f64::from((p - Vec3::ONE).dot(edge) / edge.length_squared());
        [along(x), along(y)]
    };
    let hit = |p, wi| hit_quad(p, wi, corners);
    check(desc, &corners, hit, Some(&place));
}

#[test]
fn flat_quad() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.6, 1.2, 0.0), Vec3::Y];
    let desc = ShapeDesc::Quad([corners[0], corners[1], corners[3], corners[2]]);
    check(desc, &corners, |p, wi| hit_quad(p, wi, corners), None);
}

/// Where nothing of a twisted patch hides another part of it, samples cover the solid angle that
/// small flat pieces of it fill together.
#[test]
fn twisted_quad() {
    let corners = [
        Vec3::ZERO,
        Vec3::new(1.0, 0.0, 0.4),
        Vec3::new(0.0, 1.0, 0.5),
        Vec3::new(1.2, 1.1, -0.3),
    ];
    let patch = BilinearPatch::new(corners).expect("a patch");
    let solid_angle = |p: Vec3| {
        const N: u16 = 64;
        let at = |i: u16, j: u16| {
            let (u, v) = (f32::from(i) / f32::from(N), f32::from(j) / f32::from(N));
            let [a, b, c, d] = corners;
            a.lerp(b, u).lerp(c.lerp(d, u), v)
        };
        let cells = (0..N * N).map(|k| (k % N, k / N));
        let piece = |(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            let to = 0.25 * (a + b + c + d) - p;
            let across = 0.5 * (d - a).cross(c - b).dot(to.normalize()).abs();
            f64::from(across / to.length_squared())
        };
        cells.map(piece).sum::<f64>()
    };
    let mut rng = Rng::new(11);
    for p in [Vec3::new(0.5, 0.4, 2.0), Vec3::new(0.2, 0.9, -1.0)] {
        let ctx = LightSampleContext::medium(p);
        let mut pdfs_agree = true;
        let estimate = Estimate::of(1 << 14, || {
            let sample = patch.sample_toward(&ctx, rng.vec2()).expect("in full view");
            let again = patch.pdf_toward(&ctx, sample.wi);
            pdfs_agree &= (again - sample.pdf).abs() < 1e-3 * sample.pdf;
            1.0 / f64::from(sample.pdf)
        });
        let truth = solid_angle(p);
        assert!(
            (estimate.mean - truth).abs() < estimate.margin(truth) + 1e-3 * truth,
            "{p}: {estimate:?}, {truth}"
        );
        assert!(pdfs_agree, "{p}: densities of samples");
    }
}

#[test]
fn sphere() {
    let desc = ShapeDesc::Sphere {
        transform: tilted(),
        radius: 0.7,
    };
    let place = |p: Vec3| {
        let ([x, y, z], _) = local(p, Vec3::X);
        [turn(x, y), 0.5 + 0.5 * z / 0.7]
    };
    let hit = |p, wi| {
        let ([x, y, z], [a, b, c]) = local(p, wi);
        let nearest = x * a + y * b + z * c;
        let height_sq = nearest * nearest - (x * x + y * y + z * z - 0.49);
        let half = height_sq.max(0.0).sqrt();
        let hits = [-nearest - half, -nearest + half];
        let t = hits.into_iter().find(|&t| t > 0.0 && height_sq > 0.0)?;
        Some(-(nearest + t))
    };
    check(desc, &box_around(0.7, 0.7), hit, Some(&place));
}

#[test]
fn disk_and_annulus() {
    for inner_radius in [0.0f32, 0.5] {
        let desc = ShapeDesc::Disk {
            transform: tilted(),
            radius: 0.8,
            inner_radius,
        };
        let hole = f64::from(inner_radius).powi(2);
        let place = |p: Vec3| {
            let ([x, y, _], _) = local(p, Vec3::X);
            [turn(x, y), (x * x + y * y - hole) / (0.64 - hole)]
        };
        let hit = |p, wi| {
            let ([x, y, z], [a, b, c]) = local(p, wi);
            let t = -z / c;
            let r = (x + t * a).hypot(y + t * b);
            (t > 0.0 && (f64::from(inner_radius)..0.8).contains(&r)).then_some(-c)
        };
        check(desc, &box_around(0.8, 0.0), hit, Some(&place));
    }
}

#[test]
fn cylinder() {
    let desc = ShapeDesc::Cylinder {
        transform: tilted(),
        radius: 0.4,
        length: 1.4,
    };
    let place = |p: Vec3| {
        let ([x, y, z], _) = local(p, Vec3::X);
        [turn(x, y), 0.5 + z / 1.4]
    };
    let hit = |p, wi| {
        let ([x, y, z], [a, b, c]) = local(p, wi);
        let (speed_sq, along) = (a * a + b * b, x * a + y * b);
        let half_sq = along * along - speed_sq * (x * x + y * y - 0.16);
        let half = half_sq.max(0.0).sqrt();
        let hits = [(-along - half) / speed_sq, (-along + half) / speed_sq];
        let is_wall = |t: &f64| *t > 0.0 && half_sq > 0.0 && (z + t * c).abs() < 0.7;
        let t = hits.into_iter().find(is_wall)?;
        Some(-(along + t * speed_sq))
    };
    check(desc, &box_around(0.4, 0.7), hit, Some(&place));
}

/// With an image and an alpha mask the power is that of what is left, and samples carry it.
#[test]
fn textures() {
    let texels = (0..48u16).flat_map(|i| [f32::from(i % 5), 1.0, f32::from(i % 3)]);
    let image = Image::from_f32([8, 6], Channels::Rgb, texels.collect::<Vec<_>>());
    let alpha = Image::from_f32([4, 1], Channels::Gray, [1.0, 0.25, 0.0, 0.75]);
    let emission = DiffuseEmission::<Rgb>::new(
        DiffuseEmissionDesc {
            mask: EmissionMask::Alpha(alpha.expect("a mask").into()),
            ..DiffuseEmissionDesc::new(
                SurfaceColor::Image {
                    texture: image.expect("an image").into(),
                    tint: Vec3::ONE,
                },
                RadianceAmount::Radiometric(0.5),
            )
        },
        [] as [AnyShape; 0],
    );
    let emission = emission.expect("an emission, the same on all shapes");
    let descs = [
        ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]),
        ShapeDesc::Rectangle {
            corner: Vec3::ZERO,
            edges: [Vec3::X, Vec3::Y],
        },
        ShapeDesc::Disk {
            transform: tilted(),
            radius: 0.8,
            inner_radius: 0.0,
        },
    ];
    for desc in descs {
        let shape = desc.build().expect("a shape");
        let light = DiffuseAreaLight::new(&shape, &emission);
        let mut rng = Rng::new(12);
        let estimate = Estimate::of(1 << 15, || {
            let sample = light.sample_le(rng.vec2(), rng.vec2(), &());
            sample.map_or(0.0, |s| {
                let cos = s.ray.normal.dot(s.ray.direction);
                f64::from(s.l.element_sum() / 3.0 * cos / (s.pdf.pos * s.pdf.dir))
            })
        });
        let phi = f64::from(light.phi(&()).element_sum() / 3.0);
        assert!(estimate.agrees_with(phi), "{desc:?}: {phi}, {estimate:?}");
    }
}

/// Checks the laws for a shape, one-sided and two-sided. `hit` returns where a ray first meets the
/// shape, as a number that is positive on its front and negative on its back; `corners` are those
/// of something convex around it; `place` takes points of the shape evenly to the unit square.
fn check(
    desc: ShapeDesc,
    corners: &[Vec3],
    hit: impl Fn(Vec3, Vec3) -> Option<f64>,
    place: Option<&dyn Fn(Vec3) -> [f64; 2]>,
) {
    let shape = desc.build().expect("a shape");
    let (center, radius) = shape.bounds().bounding_sphere();
    for sides in [Sides::Front, Sides::Back, Sides::Both] {
        let emission = DiffuseEmission::new(
            DiffuseEmissionDesc::<Rgb> {
                sides,
                ..DiffuseEmissionDesc::new(
                    SurfaceColor::Uniform(Vec3::ONE),
                    RadianceAmount::Radiometric(1.5),
                )
            },
            [&shape],
        );
        let emission = emission.expect("an emission");
        let light = DiffuseAreaLight::new(&shape, &emission);
        let name = format!("{desc:?}, {sides:?}");
        let case = LightCase::<Rgb, _>::around(&name, &light, center, radius, 5);
        let radiance = |p, wi| match (hit(p, wi), sides) {
            (Some(side), Sides::Front) if side > 0.0 => 1.5,
            (Some(side), Sides::Back) if side < 0.0 => 1.5,
            (Some(_), Sides::Both) => 1.5,
            _ => 0.0,
        };
        let is_convex = matches!(
            shape,
            AnyShape::Triangle(_) | AnyShape::Rectangle(_) | AnyShape::Disk(_)
        );
        // Which sides emit light does not change the density.
        if sides == Sides::Both {
            li_follows_its_density(&case, |p| cap_around(p, corners), radiance);
        }
        li_adds_up(&case, |p| cap_around(p, corners), radiance);
        le_adds_up_to_phi(&case);
        le_directions_are_diffuse(&case);
        let is_flat = is_convex || matches!(shape, AnyShape::BilinearPatch(_));
        // Rays from the inside of a closed shape would meet it again.
        if is_flat || sides == Sides::Front {
            rays_and_samples_light_alike(&case, center, 1.3 * radius);
        }
        if let Some(place) = place {
            le_origins_are_even(&case, place);
        }
        if is_convex {
            le_has_no_variance(&case);
            flux_is_phi(&case);
        }
        bounds_hold(&case);
        edges_are_survived(&case);
    }
}
