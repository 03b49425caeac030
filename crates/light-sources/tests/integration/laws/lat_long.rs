use core::f64::consts::PI;

use light_sources::glam::{Affine3A, DVec3, Quat, Vec2, Vec3};
use light_sources::light_bounds::{LightExtent, LightSampleContext};
use light_sources::light_math::lat_long;
use light_sources::*;
use light_testkit::laws::light::*;
use light_testkit::{Cap, Rng, edge_cases};

use crate::laws::{SCENE_RADIUS, scene};

const COVERAGES: [PdfCoverage; 2] = [PdfCoverage::Complete, PdfCoverage::Incomplete];

fn sky(image: &Image, transform: Affine3A) -> ImageInfiniteLight<Rgb> {
    let desc = ImageInfiniteLightDesc {
        map: EnvironmentMap::LatLong(image.clone()),
        transform,
        amount: RadianceAmount::Radiometric(2.0),
    };
    ImageInfiniteLight::new(desc, scene()).expect("an environment")
}

fn gray([width, height]: [u32; 2], texel: impl FnMut(u32) -> f32) -> Image {
    let texels: Vec<f32> = (0..width * height).map(texel).collect();
    Image::from_f32([width, height], Channels::Gray, texels).expect("an image")
}

/// Half of the texels black, a few bright.
fn uneven(size: [u32; 2]) -> Image {
    gray(size, |i| (i % 2) as f32 * (1.0 + (i * 7 % 13) as f32))
}

#[test]
fn image_infinite_by_latitude_and_longitude() {
    for size in [[8, 4], [5, 3], [2, 1]] {
        let image = uneven(size);
        let light = sky(&image, Affine3A::from_rotation_x(0.4));
        let case = LightCase::<Rgb, _>::around("lat-long sky", &light, Vec3::ZERO, 1.0, 2);
        let to_map = Affine3A::from_rotation_x(-0.4);
        let radiance = |_, wi| {
            let uv = lat_long::uv(to_map.transform_vector3(wi));
            2.0 * f64::from(image.nearest(uv).x)
        };
        li_follows_its_density(&case, |_| Cap::sphere(), radiance);
        li_adds_up(&case, |_| Cap::sphere(), radiance);
        le_adds_up_to_phi(&case);
        infinite_flux_is_phi(&case, SCENE_RADIUS);
        le_directions_follow_their_density(&case, &Cap::sphere(), Vec3::ZERO);
        rays_and_samples_light_alike(&case, Vec3::new(0.5, -1.0, 0.7), 3.0);
        bounds_hold(&case);
        edges_are_survived(&case);
    }
}

/// Colour and density of a sample are those that are queried for its direction, to the last bit,
/// on all edges of texels and at the poles too.
#[test]
fn samples_are_what_queries_answer() {
    let mut rng = Rng::new(83);
    let ctx = LightSampleContext::medium(Vec3::ZERO);
    for size in [[1, 1], [8, 4], [37, 21], [512, 256], [4096, 64]] {
        let image = gray(size, |_| rng.log_range(0.01, 100.0));
        for turn in 0..4u8 {
            let axis = rng.direction();
            let angle = 1.3 * f32::from(turn);
            let light = sky(
                &image,
                Affine3A::from_quat(Quat::from_axis_angle(axis, angle)),
            );
            for i in 0..4000u16 {
                let edges = edge_cases::EDGES_OF_U;
                let mut coordinate = |n: u32| match rng.below(3) {
                    0 => edges[rng.below(edges.len())],
                    1 => rng.below(n as usize) as f32 / n as f32,
                    _ => rng.f32(),
                };
                let u = Vec2::new(coordinate(size[0]), coordinate(size[1]));
                let coverage = COVERAGES[usize::from(i % 2)];
                let sample = light.sample_li(&ctx, u, &(), coverage).expect("light");
                let what = format!("{size:?}, {u}: {sample:?}");
                assert_eq!(sample.l, light.le(ctx.p, sample.wi, &()), "{what}");
                assert_eq!(
                    sample.pdf,
                    light.pdf_li(&ctx, sample.wi, coverage),
                    "{what}"
                );
                let ray = light.sample_le(u, Vec2::splat(0.5), &()).expect("light");
                assert_eq!(light.pdf_le(&ray.ray).dir, ray.pdf.dir, "{what}");
            }
        }
    }
}

/// A sun of a single texel is sampled and seen in that texel alone, with all of its energy.
#[test]
fn a_sun_of_one_texel_keeps_its_energy_in_its_texel() {
    let size = [64, 32];
    let ctx = LightSampleContext::medium(Vec3::ZERO);
    let mut rng = Rng::new(84);
    for [x, y] in [[40, 9], [0, 0], [63, 31], [63, 16], [0, 15], [17, 1]] {
        let image = gray(size, |i| if i == y * size[0] + x { 5000.0 } else { 0.0 });
        let light = sky(&image, Affine3A::from_rotation_z(0.3));
        let edge = |y: u32| (PI * f64::from(y) / 32.0).cos();
        let solid_angle = 2.0 * PI / 64.0 * (edge(y) - edge(y + 1));
        let energy = 2.0 * 5000.0 * solid_angle;
        let area = PI * f64::from(SCENE_RADIUS).powi(2);
        let phi = f64::from(light.phi(&()).x) / area;
        assert!(
            (phi / energy - 1.0).abs() < 1e-6,
            "{x} {y}: {phi} of {energy}"
        );
        for _ in 0..4000 {
            for coverage in COVERAGES {
                let sample = light
                    .sample_li(&ctx, rng.vec2(), &(), coverage)
                    .expect("sun");
                let uv = lat_long::uv(Affine3A::from_rotation_z(-0.3).transform_vector3(sample.wi));
                let at = uv * Vec2::new(64.0, 32.0) - Vec2::new(x as f32, y as f32);
                assert!(
                    at.min_element() > -1e-3 && at.max_element() < 1.001,
                    "{x} {y}: {at}"
                );
                let estimate = f64::from(sample.l.x / sample.pdf);
                assert!(
                    (estimate / energy - 1.0).abs() < 1e-5,
                    "{x} {y}: {estimate}"
                );
            }
        }
    }
}

/// What the bounds say of a sky is its integral.
#[test]
fn bounds_are_integrals() {
    let mut rng = Rng::new(85);
    for size in [[1, 1], [1, 3], [4, 1], [6, 5], [9, 4]] {
        let [width, height] = size;
        let image = gray(size, |_| rng.log_range(0.1, 10.0));
        let light = sky(&image, Affine3A::IDENTITY);
        let LightExtent::Infinite(bounds) = light.extent() else {
            panic!("at infinity");
        };
        const PARTS: u32 = 400;
        let (mut mean, mut fluence) = (DVec3::ZERO, 0.0);
        for row in 0..height * PARTS {
            let step = PI / f64::from(height * PARTS);
            let (sin_t, cos_t) = (step * (f64::from(row) + 0.5)).sin_cos();
            for x in 0..width {
                let radiance = 2.0 * f64::from(image.texel(x, row / PARTS).x);
                let column = 2.0 * PI / f64::from(width);
                for part in 0..64u8 {
                    let p = column * (f64::from(x) + (f64::from(part) + 0.5) / 64.0);
                    let weight = radiance * step * column / 64.0 * sin_t;
                    mean += DVec3::new(sin_t * p.sin(), cos_t, -sin_t * p.cos()) * weight;
                    fluence += weight;
                }
            }
        }
        let error = bounds.mean.as_dvec3().distance(mean / fluence);
        assert!(error < 1e-4, "{size:?}: {bounds:?}, {}", mean / fluence);
        let ratio = f64::from(bounds.fluence) / fluence;
        assert!((ratio - 1.0).abs() < 1e-5, "{size:?}: {ratio}");
    }
}

/// Every texel with light has a density, at both ends of the range and at the poles; black ones
/// have none.
#[test]
fn whatever_contributes_has_a_density() {
    let ctx = LightSampleContext::medium(Vec3::ZERO);
    let dim = f32::from_bits(1);
    for texels in [[dim, 3e36, 0.0, 1.0], [dim; 4], [1e37, dim, 1e37, 0.0]] {
        let image = gray([1, 4], |i| texels[i as usize]);
        let light = sky(&image, Affine3A::IDENTITY);
        for (texel, y) in texels.iter().zip([1.0, 0.5, -0.5, -1.0f32]) {
            let wi = Vec3::new((1.0 - y * y).sqrt(), y, 0.0);
            let pdf = light.pdf_li(&ctx, wi, PdfCoverage::Complete);
            assert_eq!(pdf > 0.0, *texel > 0.0, "{texels:?}, {y}: {pdf}");
            assert!(pdf.is_finite(), "{texels:?}, {y}: {pdf}");
        }
    }
    let black = sky(&gray([4, 2], |_| 0.0), Affine3A::IDENTITY);
    for coverage in COVERAGES {
        let sample = black.sample_li(&ctx, Vec2::splat(0.5), &(), coverage);
        assert!(sample.is_none(), "black: {sample:?}");
        assert_eq!(black.pdf_li(&ctx, Vec3::Z, coverage), 0.0, "black");
    }
}

/// Texels that are not above the mean are left out by samples that may leave out directions; of a
/// sky that is the same everywhere, none is.
#[test]
fn compensation_leaves_what_is_above_the_mean_over_the_sphere() {
    let ctx = LightSampleContext::medium(Vec3::ZERO);
    // By solid angle the mean is 1.94; by number of texels it would be 2.25.
    let image = gray([1, 4], |i| [4.0, 2.0, 1.0, 2.0][i as usize]);
    let light = sky(&image, Affine3A::IDENTITY);
    let pdf = |y: f32| {
        let wi = Vec3::new((1.0 - y * y).sqrt(), y, 0.0);
        light.pdf_li(&ctx, wi, PdfCoverage::Incomplete)
    };
    assert!(pdf(0.5) > 0.0 && pdf(-0.9) > 0.0, "above the mean");
    assert_eq!(pdf(-0.5), 0.0, "below the mean");
    let even = sky(&gray([6, 4], |_| 0.3), Affine3A::IDENTITY);
    for u in [Vec2::ZERO, Vec2::splat(0.3), Vec2::splat(0.99)] {
        let sample = even.sample_li(&ctx, u, &(), PdfCoverage::Incomplete);
        let density = 4.0 * core::f32::consts::PI * sample.expect("light").pdf;
        assert!((density - 1.0).abs() < 1e-5, "{u}: {density}");
    }
}

/// What cannot be summed is refused.
#[test]
fn too_bright_to_be_summed() {
    let texels = vec![2e38; 3];
    let image = Image::from_f32([1, 1], Channels::Rgb, texels).expect("an image");
    for map in [EnvironmentMap::LatLong, EnvironmentMap::EqualArea] {
        let desc = ImageInfiniteLightDesc::new(map(image.clone()));
        let error = ImageInfiniteLight::<Rgb>::new(desc, scene()).err();
        let too_bright = Some(ImageInfiniteLightError::TooBright);
        assert_eq!(error, too_bright, "sum above the range");
        let says = error.map(|error| error.to_string()).unwrap_or_default();
        assert!(says.starts_with("map: "), "{says}");
    }
}
