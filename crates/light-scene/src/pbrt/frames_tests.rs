//! Lights with a picture, each texel of another brightness: no turned or mirrored frame throws the
//! same.

use std::path::Path;

use lights::sources::{
    GoniometricLight, ImageInfiniteLight, InfiniteLight, LightDesc, PointSource,
    PortalInfiniteLight, ProjectionLight, Rgb, SceneSphere,
};

use super::parse_pbrt;
use crate::glam::{Vec2, Vec3};
use crate::image::tests::png;
use crate::{Color, Diagnostic, Files, Scene};

/// Takes (x, y, z) to (z, x, -y), and the origin to (1, 2, 3).
const TRANSFORM: &str = "Transform [0 1 0 0  0 0 -1 0  1 0 0 0  1 2 3 1]";

fn turned(Vec3 { x, y, z }: Vec3) -> Vec3 {
    Vec3::new(z, x, -y)
}

/// The bytes of the files beside the scene: a picture of 4 by `rows` blocks, the brightness of each
/// in proportion to its number, and a luminaire of type C with another intensity in each quadrant.
fn read_sibling(path: &Path) -> Result<Vec<u8>, Diagnostic> {
    const BLOCK: u32 = 16;
    let picture = |rows: u32| {
        let texel = |x: u32, y: u32| {
            let number = 1 + x / BLOCK + 4 * (y / BLOCK);
            image::Luma([u16::try_from(number * 4095).expect("16 blocks at most")])
        };
        let image = image::ImageBuffer::<image::Luma<u16>, Vec<u16>>::from_fn(
            4 * BLOCK,
            rows * BLOCK,
            texel,
        );
        png(image::DynamicImage::ImageLuma16(image))
    };
    match path.to_str() {
        Some("square.png") => Ok(picture(4)),
        Some("wide.png") => Ok(picture(2)),
        Some("a.ies") => Ok(
            b"IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 4 1 2 0 0 0\n1 1 100\n0 180\n0 90 180 270\n\
            100 100\n200 200\n300 300\n400 400\n"
                .to_vec(),
        ),
        _ => Err(Diagnostic::file(path, "cannot be read")),
    }
}

/// The number of the block that gives so much light.
fn number(light: f32) -> f32 {
    // Files for screens are encoded by sRGB.
    let encoded = 1.055 * light.powf(1.0 / 2.4) - 0.055;
    encoded * 65535.0 / 4095.0
}

#[test]
fn maps_that_are_not_square_are_refused_with_what_makes_one() {
    let text = "WorldBegin LightSource \"infinite\" \"string filename\" \"wide.png\"";
    let refused = parse_pbrt(Path::new("a"), text, Files::new(&read_sibling));
    let message = refused.expect_err("a wide image").to_string();
    for word in ["a:1: expected a square", "lights env convert"] {
        assert!(message.contains(word), "{word} in {message}");
    }
}

fn scene(text: &str) -> Scene {
    let scene = parse_pbrt(Path::new("a"), text, Files::new(&read_sibling)).expect("a scene");
    assert_eq!(scene.warnings, [], "{text}");
    scene
}

fn light(parameters: &str) -> LightDesc<Rgb> {
    let scene = scene(&format!("WorldBegin {TRANSFORM} LightSource {parameters}"));
    scene.lights[0].clone()
}

/// The eight diagonals that lead to the middles of blocks of a square equal-area picture: each with
/// the number of its block.
///
/// # Source
/// `[PBRT4]`, section 3.8.3: the upper half of the sphere is the rhomb in the middle of the square,
/// x and y run with columns and rows.
fn diagonals() -> impl Iterator<Item = (Vec3, f32)> {
    (0..8u8).map(|octant| {
        let is_negative = [0, 1, 2].map(|axis| octant >> axis & 1 == 1);
        let sign = Vec3::from(is_negative.map(|negative| if negative { -1.0 } else { 1.0 }));
        let side = (0.5f32 * (1.0 - 0.75 * 0.75)).sqrt();
        let block = |axis: usize| match (is_negative[axis], is_negative[2]) {
            (false, false) => 2.0,
            (true, false) => 1.0,
            (false, true) => 3.0,
            (true, true) => 0.0,
        };
        let direction = sign * Vec3::new(side, side, 0.75);
        (direction, 1.0 + block(0) + 4.0 * block(1))
    })
}

fn assert_block(found: f32, expected: f32, what: &str) {
    assert!(
        (found - expected).abs() < 1e-2,
        "{what}: block {found}, not {expected}"
    );
}

/// [`PBRT4`], `lights.cpp`: y is turned over between the picture and the transform in force.
#[test]
fn projections_stand_upright() {
    let LightDesc::Projection(desc) = light("\"projection\" \"string filename\" \"wide.png\"")
    else {
        panic!("a projection");
    };
    let light = ProjectionLight::<Rgb>::new(desc).expect("a light");
    assert_eq!(light.position(), Vec3::new(1.0, 2.0, 3.0), "place");
    for (column, row) in (0..8u8).map(|k| (k % 4, k / 4)) {
        let (x, y) = (f32::from(column), f32::from(row));
        // At 90 degrees rows span [-1, 1] on the plane z = 1, the upper one above.
        let w = Vec3::new(x - 1.5, 0.5 - y, 1.0).normalize();
        let found = number(light.intensity(turned(w), &()).y);
        assert_block(found, 1.0 + x + 4.0 * y, "projection");
    }
}

/// [`PBRT4`], `lights.cpp`: y and z change places between the picture and the transform in force.
#[test]
fn goniometric_pictures_have_z_up() {
    let LightDesc::Goniometric(desc) = light("\"goniometric\" \"string filename\" \"square.png\"")
    else {
        panic!("a goniometric light");
    };
    let light = GoniometricLight::<Rgb>::new(desc).expect("a light");
    for (d, expected) in diagonals() {
        let toward = turned(Vec3::new(d.x, d.z, d.y));
        let found = number(light.intensity(toward, &()).y);
        assert_block(found, expected, "goniometric");
    }
}

#[test]
fn skies_lie_as_the_transform_says() {
    let around = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let LightDesc::ImageInfinite(desc) = light("\"infinite\" \"string filename\" \"square.png\"")
    else {
        panic!("a sky");
    };
    let light = ImageInfiniteLight::<Rgb>::new(desc, around).expect("a light");
    for (d, expected) in diagonals() {
        let found = number(light.le(Vec3::ZERO, turned(d), &()).y);
        assert_block(found, expected, "sky");
    }
}

/// [`PBRT4`], `lights.cpp`: the transform in force acts on the sky, not on the portal.
#[test]
fn portals_are_in_the_world_and_show_the_sky_as_it_lies() {
    let around = SceneSphere::new(Vec3::ZERO, 10.0).expect("a sphere");
    let portal = "\"point3 portal\" [0 -1 -1  0 -1 1  0 1 1  0 1 -1]";
    let text = format!("\"infinite\" \"string filename\" \"square.png\" {portal}");
    let LightDesc::PortalInfinite(desc) = light(&text) else {
        panic!("a portal");
    };
    let light = PortalInfiniteLight::<Rgb>::new(desc, around).expect("a light");
    let through = diagonals().filter(|(d, _)| d.z > 0.0);
    for (d, expected) in through {
        let found = number(light.le(Vec3::NEG_X, turned(d), &()).y);
        assert_block(found, expected, "portal");
    }
}

/// The intensity of the luminaire, in parts of its largest, in a level direction.
fn level(camera: &str, w: Vec3) -> f32 {
    let lamp = "LightSource \"goniometric\" \"string filename\" \"a.ies\"";
    let text = format!("{camera} Camera \"perspective\" WorldBegin {lamp}");
    let scene = parse_pbrt(Path::new("a"), &text, Files::new(&read_sibling)).expect("a scene");
    let LightDesc::Goniometric(desc) = scene.lights[0].clone() else {
        panic!("a goniometric light");
    };
    let peak = desc
        .distribution
        .texels()
        .fold(0.0f32, |peak, t| peak.max(t.x));
    let local = desc.transform.inverse().transform_vector3(w);
    let place = lights::math::equal_area::sphere_to_square(local);
    desc.distribution.nearest(place).x / peak
}

/// Seen from above the horizontal angles of type C run counter-clockwise. The default camera looks
/// along z with x to the right: from above, and with z ahead, counter-clockwise is from x to z;
/// where the file mirrors the camera it is from x to -z.
#[test]
fn luminaires_are_not_mirrored() {
    for (camera, side) in [("", 1.0), ("Scale -1 1 1", -1.0)] {
        for (w, quarters) in [
            (Vec3::X, 1.0),
            (Vec3::Z * side, 2.0),
            (Vec3::NEG_X, 3.0),
            (Vec3::NEG_Z * side, 4.0),
        ] {
            let found = level(camera, w) * 4.0;
            assert!((found - quarters).abs() < 0.05, "`{camera}`, {w}: {found}");
        }
    }
}

/// [`PBRT4`]: an image's upper row is where v is 1, for lights and for textures.
#[test]
fn images_on_surfaces_stand_upright() {
    let shape = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0  1 0 0  0 1 0  1 1 0]
        \"point2 uv\" [0 0  1 0  0 1  1 1]";
    let lamp = "AreaLightSource \"diffuse\" \"string filename\" \"square.png\"";
    let texture = "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"square.png\"
        Material \"diffuse\" \"texture reflectance\" \"t\"";
    let text = format!("WorldBegin {texture} {lamp} {shape}");
    let scene = parse_pbrt(Path::new("a"), &text, Files::new(&read_sibling)).expect("a scene");
    let material = scene.material(scene.meshes[0].material);
    let emitted = material.emission.expect("a lamp").radiance;
    let crate::Surface::Diffuse { reflectance } = material.surface else {
        panic!("a diffuse surface");
    };
    for color in [emitted, reflectance] {
        let Color::Image(shown) = color else {
            panic!("an image");
        };
        let image = scene.images[shown.image.0 as usize]
            .to_light()
            .expect("light");
        for (column, row) in (0..16u8).map(|k| (k % 4, k / 4)) {
            let (x, y) = (f32::from(column), f32::from(row));
            let uv = Vec2::new(0.25 * (x + 0.5), 1.0 - 0.25 * (y + 0.5));
            let found = number(image.on_surface(uv, &shown.mapping).y);
            assert_block(found, 1.0 + x + 4.0 * y, "texture");
        }
    }
}

/// Directions have no length; what is not alike along all axes would turn some of them.
#[test]
fn a_scale_along_all_axes_changes_no_frame() {
    let lights = [
        "\"infinite\" \"string filename\" \"square.png\"",
        "\"projection\" \"string filename\" \"wide.png\"",
        "\"goniometric\" \"string filename\" \"square.png\"",
        "\"goniometric\" \"string filename\" \"a.ies\"",
    ];
    let transform = |light: &LightDesc<Rgb>| match light {
        LightDesc::ImageInfinite(light) => light.transform,
        LightDesc::Projection(light) => light.transform,
        LightDesc::Goniometric(light) => light.transform,
        other => panic!("not {other:?}"),
    };
    for parameters in lights {
        let text =
            |scale: &str| format!("WorldBegin {TRANSFORM} Scale {scale}\nLightSource {parameters}");
        let parse = |scale| parse_pbrt(Path::new("a"), &text(scale), Files::new(&read_sibling));
        let [plain, scaled] = ["1 1 1", "3 3 3"].map(|scale| {
            let scene = parse(scale).expect("a scene");
            transform(&scene.lights[0])
        });
        assert!(
            scaled.abs_diff_eq(plain, 1e-6),
            "{parameters}: {scaled} for {plain}"
        );
        let refused = parse("1 2 1");
        let message = refused.expect_err(parameters).to_string();
        let end = "transform: must be rigid, without scale or shear";
        assert!(
            message.starts_with("a:2: ") && message.ends_with(end),
            "{message}"
        );
    }
}
