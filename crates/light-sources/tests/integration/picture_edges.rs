//! The edges of pictures: what is sampled there is found again by its direction, however wide the
//! picture.

use light_math::float::ONE_MINUS_EPSILON;
use light_sources::glam::{Affine3A, Quat, Vec2, Vec3};
use light_sources::light_bounds::LightSampleContext;
use light_sources::shape::{BilinearPatch, BilinearPatchError};
use light_sources::*;

fn white() -> Image {
    Image::from_f32([1, 1], Channels::Gray, [1.0]).expect("an image")
}

fn turn(i: u8) -> Affine3A {
    let axis = Vec3::new(1.0, 0.3 * f32::from(i), -0.5).normalize();
    Affine3A::from_quat(Quat::from_axis_angle(axis, 0.7 * f32::from(i)))
}

fn corners() -> impl Iterator<Item = Vec2> {
    let ends = [0.0, 0.3, ONE_MINUS_EPSILON];
    ends.into_iter()
        .flat_map(move |x| ends.map(|y| Vec2::new(x, y)))
}

fn projection(
    fov: f32,
    transform: Affine3A,
    image: Image,
) -> Result<ProjectionLight<Rgb>, ProjectionLightError> {
    ProjectionLight::new(ProjectionLightDesc {
        transform,
        image,
        fov,
        amount: IntensityAmount::Radiometric(1.0),
        media: MediumInterface::default(),
    })
}

/// One bright texel among black ones.
fn spotted() -> Image {
    let texels = (0..12u8).map(|i| f32::from(u8::from(i == 6)));
    Image::from_f32([4, 3], Channels::Gray, texels.collect::<Vec<_>>()).expect("an image")
}

/// At the corners of a texel, rounding of a direction may lead to a black one beside it.
#[test]
fn rays_at_the_edge_of_a_texel_have_the_queried_density() {
    let mut found = 0;
    for fov in [1e-4, 0.01, 1.0, 2.0, 2.8, 3.1, 3.137, 3.1414] {
        for (i, image) in (0..16).flat_map(|i| [(i, white()), (i, spotted())]) {
            let light = projection(fov, turn(i), image).expect("a projection");
            for u in corners() {
                let Some(sample) = light.sample_le(u, Vec2::ZERO, &()) else {
                    continue;
                };
                let queried = light.pdf_le(&sample.ray).dir;
                assert_eq!(sample.pdf.dir, queried, "for {u} at {fov}, turn {i}");
                found += 1;
            }
        }
    }
    assert!(found > 1500, "{found} of 2304 samples");
}

#[test]
fn a_picture_that_directions_cannot_resolve_is_refused() {
    for fov in [1e-7, 1e-6, core::f32::consts::PI * (1.0 - 1e-6)] {
        let error = projection(fov, Affine3A::IDENTITY, white())
            .map(|_| ())
            .err();
        assert_eq!(error, Some(ProjectionLightError::Fov), "{fov}");
    }
}

/// A square of black and white texels.
fn checkered() -> Image {
    let texels = (0..64u8).map(|i| f32::from((i + i / 8) % 2));
    Image::from_f32([8, 8], Channels::Gray, texels.collect::<Vec<_>>()).expect("an image")
}

#[test]
fn a_portal_whose_density_of_places_is_no_float_is_refused() {
    let portal = |side: f32| {
        let [x, y] = [Vec3::X, Vec3::Y].map(|v| v * side);
        PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(white()),
            amount: RadianceAmount::Radiometric(1.0),
            portal: [Vec3::ZERO, y, y + x, x],
        }
    };
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    let refusal = |side| PortalInfiniteLight::<Rgb>::new(portal(side), scene).err();
    assert_eq!(refusal(1e-18), Some(PortalInfiniteLightError::Portal));
    assert_eq!(refusal(1e-16), None);
}

#[test]
fn light_through_the_corner_of_a_portal_arrives() {
    let portal = [Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X, Vec3::X];
    for i in 0..16 {
        let transform = turn(i);
        let desc = PortalInfiniteLightDesc {
            transform: Affine3A::IDENTITY,
            map: EnvironmentMap::EqualArea(checkered()),
            amount: RadianceAmount::Radiometric(1.0),
            portal: portal.map(|p| transform.transform_point3(p)),
        };
        let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
        let light = PortalInfiniteLight::<Rgb>::new(desc, scene).expect("a portal");
        for p in [Vec3::new(0.3, 0.6, 1.0), Vec3::new(-2.0, 3.0, 0.2)] {
            // From both sides, as light passes one way only.
            for p in [p, p * Vec3::new(1.0, 1.0, -1.0)] {
                let p = transform.transform_point3(p);
                let ctx = LightSampleContext::medium(p);
                for u in corners() {
                    let sample = light.sample_li(&ctx, u, &(), PdfCoverage::Complete);
                    let Some(sample) = sample else { continue };
                    let l = light.le(p, sample.wi, &());
                    assert_eq!(l, sample.l, "{u}, from {p}, turn {i}");
                    let queried = light.pdf_li(&ctx, sample.wi, PdfCoverage::Complete);
                    assert_eq!(sample.pdf, queried, "{u}, from {p}, turn {i}");
                }
            }
        }
    }
}

#[test]
fn a_patch_whose_area_is_rounding_is_refused() {
    // All corners on a line, but for the least number.
    let p = Vec3::new(-1.945_312_5, 0.0, -2.0);
    let corners = [Vec3::ZERO, p, Vec3::NEG_Y * f32::MIN_POSITIVE, Vec3::ZERO];
    let error = BilinearPatch::new(corners).err();
    assert_eq!(error, Some(BilinearPatchError::Area), "no area");
}

/// At the edges of a texel of an equal-area sky, rounding of a direction may lead to the one beside
/// it, or across the edge of the square to one far away.
#[test]
fn directions_at_the_edge_of_a_texel_of_the_sky_are_its_own() {
    let ctx = LightSampleContext::medium(Vec3::ZERO);
    let scene = SceneSphere::new(Vec3::ZERO, 1.0).expect("a sphere");
    for (n, seed) in (2..=6u32).flat_map(|n| [1u32, 5].map(|seed| (n, seed))) {
        // Black ones among them.
        let texel = |i: u32| (i * (2 * seed + 5) % 11).saturating_sub(3) as f32;
        let texels = (0..n * n).map(texel).collect::<Vec<_>>();
        let image = Image::from_f32([n, n], Channels::Gray, texels).expect("an image");
        for i in 0..12 {
            let desc = ImageInfiniteLightDesc {
                transform: turn(i),
                ..ImageInfiniteLightDesc::new(EnvironmentMap::EqualArea(image.clone()))
            };
            let sky = ImageInfiniteLight::<Rgb>::new(desc, scene).expect("a sky");
            for coverage in [PdfCoverage::Complete, PdfCoverage::Incomplete] {
                let table = sky.table(coverage).expect("light");
                let rows = table.rows.iter().enumerate();
                let edges = rows.flat_map(|(row, &y)| {
                    let columns = &table.columns[row * n as usize..][..n as usize];
                    let beside = |u: f32| {
                        let bits = u.to_bits();
                        let [up, down] = [bits + 1, bits.saturating_sub(1)].map(f32::from_bits);
                        [u, up, down, u + 1e-7]
                    };
                    let ys = [y, 0.5 * (y + table.rows.get(row + 1).unwrap_or(&1.0))];
                    let us = columns.iter().flat_map(move |&x| beside(x));
                    us.flat_map(move |x| ys.into_iter().flat_map(beside).map(move |y| (x, y)))
                });
                let last = [(ONE_MINUS_EPSILON, 0.3), (0.3, ONE_MINUS_EPSILON)];
                for (x, y) in edges.chain(last) {
                    let u = Vec2::new(x, y).clamp(Vec2::ZERO, Vec2::splat(ONE_MINUS_EPSILON));
                    let sample = sky.sample_li(&ctx, u, &(), coverage).expect("a sample");
                    let what = format!("{n} x {n}, {coverage:?}, turn {i}, {u}");
                    assert_eq!(sky.pdf_li(&ctx, sample.wi, coverage), sample.pdf, "{what}");
                    assert_eq!(sky.le(Vec3::ZERO, sample.wi, &()), sample.l, "{what}");
                }
            }
        }
    }
}

/// As of a sky: a goniometric light has one table of them too.
#[test]
fn directions_at_the_edge_of_a_texel_of_a_luminaire_are_its_own() {
    for n in 2..=6u32 {
        for lit in 0..n * n {
            // A single texel, seen up to all its corners.
            let texels = (0..n * n).map(|i| f32::from(i == lit)).collect::<Vec<_>>();
            let image = Image::from_f32([n, n], Channels::Gray, texels).expect("an image");
            for i in 0..12 {
                let amount = IntensityAmount::default();
                let desc = GoniometricLightDesc::new(turn(i), image.clone(), Vec3::ONE, amount);
                let light = GoniometricLight::<Rgb>::new(desc).expect("a light");
                let ends = [0.0, f32::MIN_POSITIVE, 0.5, ONE_MINUS_EPSILON];
                for u in ends.into_iter().flat_map(|x| ends.map(|y| Vec2::new(x, y))) {
                    let what = format!("{lit} of {n} x {n}, turn {i}, {u}");
                    let sample = light.sample_le(u, Vec2::ZERO, &()).expect("a sample");
                    assert_eq!(light.pdf_le(&sample.ray).dir, sample.pdf.dir, "{what}");
                    let l = light.intensity(sample.ray.direction, &());
                    assert_eq!(l, sample.l, "{what}");
                }
            }
        }
    }
}
