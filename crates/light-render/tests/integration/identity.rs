//! Whatever a picture depends on is part of its identity, so that parts of other pictures are
//! refused.

use core::num::NonZeroU32;
use core::time::Duration;
use std::fs;
use std::path::PathBuf;

use light_render::integrator::{Estimator, Integrator, PathSettings, SingleScattering};
use light_render::{
    PictureIdentity, RenderSettings, SamplerKind, SceneDigest, View, Visibility, World,
};
use light_scene::glam::Vec3;
use light_scene::{Camera, Crop, Diagnostic, Files, Image, Scene, parse_scene, write_image};
use lights::media::StepSize;
use lights::sources::{EnvironmentMap, LightDesc};

/// Lights, shapes, materials, textures and media of every kind that is understood.
const SCENE: &str = r#"
Film "rgb" "integer xresolution" 20 "integer yresolution" 10
LookAt 0 1 5  0 0 0  .1 1 0
MediumInterface "" "air"
Camera "perspective" "float fov" 40 "float lensradius" .1 "float focaldistance" 4
MakeNamedMedium "air" "string type" "homogeneous" "rgb sigma_a" [ 1 2 3 ] "rgb sigma_s" [ 4 5 6 ]
  "float scale" .5 "rgb Le" [ 1 0 0 ] "float Lescale" 2 "float g" -.3
WorldBegin
MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1
  "float density" [ 1 3 ] "float temperature" [ 0 1500 ] "rgb sigma_a" [ 1 1 1 ]
  "rgb sigma_s" [ 2 2 2 ] "point3 p0" [ 0 0 0 ] "point3 p1" [ 2 1 1 ] "float g" .2
MakeNamedMedium "dye" "string type" "rgbgrid" "integer nx" 1 "integer ny" 1 "integer nz" 2
  "rgb sigma_a" [ 1 0 0  0 0 2 ] "rgb sigma_s" [ .5 .25 0  0 0 1 ] "float scale" 10
LightSource "point" "rgb I" [ 1 2 3 ] "point3 from" [ 1 2 1 ] "float scale" 2
LightSource "spot" "rgb I" [ 3 2 1 ] "point3 from" [ 0 3 0 ] "point3 to" [ 1 0 0 ]
  "float coneangle" 40 "float conedeltaangle" 10
LightSource "distant" "rgb L" [ 1 1 .5 ] "point3 from" [ 1 4 2 ] "point3 to" [ 0 0 0 ]
LightSource "infinite" "rgb L" [ .1 .2 .3 ]
AttributeBegin
  Translate 1 2 3
  LightSource "projection" "string filename" "tiles.exr" "float fov" 50 "float scale" 2
  LightSource "goniometric" "string filename" "square.exr" "rgb I" [ 2 2 1 ]
  Rotate 30 0 1 .5
  LightSource "infinite" "string filename" "square.exr" "float scale" 1.5
AttributeEnd
Texture "tiles" "spectrum" "imagemap" "string filename" "tiles.exr" "float uscale" 2
    "float vscale" 3
Material "diffuse" "rgb reflectance" [ .5 .4 .3 ]
Shape "trianglemesh" "point3 P" [ 0 0 0  1 0 .5  0 1 .25 ] "normal N" [ 0 0 1  0 .1 1  .1 0 1 ]
  "point2 uv" [ 0 0  1 .25  .5 1 ] "integer indices" [ 0 1 2  0 2 1 ] "float alpha" .75
Material "diffuse" "texture reflectance" "tiles"
Shape "sphere" "float radius" 2
Material "diffusetransmission" "rgb reflectance" [ .2 .3 .4 ] "rgb transmittance" [ .4 .3 .2 ]
Shape "disk" "float radius" .5 "float height" .25
Material "conductor" "rgb eta" [ .2 .9 1.1 ] "rgb k" [ 3.9 2.4 2.2 ] "float roughness" .2
Shape "sphere"
Material "dielectric" "float eta" 1.5 "float roughness" .1
Shape "sphere" "float radius" .25
Material "thindielectric" "float eta" 1.4
Shape "sphere" "float radius" .35
Material "coateddiffuse" "rgb reflectance" [ .3 .2 .1 ] "float eta" 1.3 "float roughness" .3
Shape "sphere" "float radius" .45
MakeNamedMaterial "a" "string type" "diffuse" "rgb reflectance" [ .1 .2 .3 ]
MakeNamedMaterial "b" "string type" "conductor" "float roughness" .15
Material "mix" "string materials" [ "a" "b" ] "float amount" .3
Shape "sphere" "float radius" .55
AttributeBegin
  Material "interface"
  MediumInterface "smoke" "dye"
  Scale 1 2 1
  Shape "sphere" "float radius" .65
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [ 5 4 3 ] "float scale" 2
  Shape "bilinearmesh" "point3 P" [ 0 3 0  1 3 0  0 3 1  1 3 1.5 ]
AttributeEnd
ObjectBegin "thing"
  Shape "trianglemesh" "point3 P" [ 0 0 0  .5 0 0  0 .5 .125  .5 .5 .25 ]
    "integer indices" [ 0 1 2  2 1 3 ]
  Shape "sphere" "float radius" .05
ObjectEnd
Translate .5 1.5 .25
ObjectInstance "thing"
Translate .5 .75 1.25
ObjectInstance "thing"
"#;

/// A folder with the images of the scene, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("lights-identity-{name}-{}", std::process::id());
        let folder = Self(std::env::temp_dir().join(name));
        fs::create_dir_all(&folder.0).expect("a folder");
        folder.image("tiles.exr", 0);
        folder.image("square.exr", 0);
        folder
    }

    /// An image of 8 texels a side, of which number `changed` is brighter.
    fn image(&self, name: &str, changed: usize) {
        let mut texels: Vec<Vec3> = (0..64u8).map(|i| Vec3::splat(f32::from(i + 1))).collect();
        texels[changed] += 1.0;
        let image = Image::new(8, 8, texels).expect("an image");
        write_image(&self.0.join(name), &image).expect("written");
    }

    fn scene(&self, text: &str) -> Result<Scene, Diagnostic> {
        let path = self.0.join("scene.pbrt");
        parse_scene(&path, text.as_bytes(), Files::DISK)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        drop(fs::remove_dir_all(&self.0));
    }
}

fn settings() -> RenderSettings {
    RenderSettings {
        samples: 0..4,
        time_limit: None,
        seed: 7,
        path: PathSettings {
            max_depth: 5,
            estimator: Estimator::Mis,
            light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
            integrator: Integrator::Path,
        },
    }
}

fn view(camera: &Camera) -> Option<View> {
    let [width, height] = camera.resolution.unwrap_or([8, 8]);
    View::new(camera, width, height).ok()
}

fn identity(scene: &Scene) -> Option<PictureIdentity> {
    let view = view(&scene.camera_or_default())?;
    let digest = SceneDigest::new(scene).ok()?;
    let world = World::new(scene.clone()).ok()?;
    let (settings, off) = (settings(), Visibility::Off);
    Some(digest.identity(&world, &view, &settings, SamplerKind::Bvh, off))
}

/// Where the numbers of a text begin and end, those in names left out.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let mut places = vec![];
    let mut at = 0;
    for (i, piece) in text.split('"').enumerate() {
        if i % 2 == 0 {
            for word in piece.split_whitespace() {
                let start = word.as_ptr() as usize - text.as_ptr() as usize;
                if word.parse::<f64>().is_ok() {
                    places.push((start, start + word.len()));
                }
            }
        }
        at += piece.len() + 1;
    }
    assert_eq!(at, text.len() + 1, "all of the text");
    places
}

#[test]
fn every_number_of_a_scene_counts() {
    let folder = Folder::new("numbers");
    let scene = folder.scene(SCENE).expect("a scene");
    let unknown = scene.warnings.len();
    let expected = identity(&scene).expect("a view");
    let (mut changed, mut refused) = (0, vec![]);
    for (start, end) in numbers(SCENE) {
        let number: f64 = SCENE[start..end].parse().expect("a number");
        let others = [number + 1.0, number * 0.5, number + 0.25, 1.0 - number, 2.0];
        let others = others.into_iter().filter(|&other| other != number);
        let scenes = others.filter_map(|other| {
            let text = format!("{}{other}{}", &SCENE[..start], &SCENE[end..]);
            let scene = folder.scene(&text).ok()?;
            // A number that is warned of is not used.
            (scene.warnings.len() == unknown).then_some(scene)
        });
        let mut identities = scenes.filter_map(|scene| identity(&scene)).peekable();
        let line = SCENE[..start].lines().count();
        if identities.peek().is_none() {
            refused.push(&SCENE[start..end]);
        } else {
            assert!(
                identities.any(|other| other.difference(&expected).is_some()),
                "line {line}: {number} does not count"
            );
            changed += 1;
        }
    }
    // The sizes of grids, which their values must fit.
    assert!(
        changed >= 150 && refused.len() <= 8,
        "{changed}, {refused:?}"
    );
}

#[test]
fn every_texel_counts() {
    let folder = Folder::new("texels");
    let of = |folder: &Folder| identity(&folder.scene(SCENE).expect("a scene")).expect("a view");
    let expected = of(&folder);
    for (name, texel) in [("tiles.exr", 1), ("tiles.exr", 63), ("square.exr", 37)] {
        folder.image(name, texel);
        assert!(
            of(&folder).difference(&expected).is_some(),
            "{name}: {texel}"
        );
        folder.image(name, 0);
        assert_eq!(of(&folder).difference(&expected), None, "{name}: as it was");
    }
}

#[test]
fn the_sky_of_the_command_line_counts() {
    let folder = Folder::new("sky");
    let mut scene = folder.scene(SCENE).expect("a scene");
    let expected = identity(&scene).expect("a view");
    let sky = Image::new(2, 1, vec![Vec3::ONE, Vec3::X]).expect("an image");
    scene
        .add_sky(&sky, light_scene::glam::Affine3A::IDENTITY)
        .expect("a sky");
    let with_sky = identity(&scene).expect("a view");
    let difference = with_sky.difference(&expected).expect("another picture");
    assert!(difference.starts_with("lights "), "{difference}");
    let Some(LightDesc::ImageInfinite(sky)) = scene.lights.last_mut() else {
        panic!("a sky");
    };
    let other = Image::new(2, 1, vec![Vec3::ONE, Vec3::Y]).expect("an image");
    sky.map = EnvironmentMap::LatLong(other.to_light().expect("light"));
    let other = identity(&scene).expect("a view");
    assert!(other.difference(&with_sky).is_some(), "another texel");
}

#[test]
fn view_and_settings_count_but_how_it_is_shown_does_not() {
    let folder = Folder::new("settings");
    let scene = folder.scene(SCENE).expect("a scene");
    let digest = SceneDigest::new(&scene).expect("no own light");
    let camera = scene.camera.expect("a camera");
    let world = World::new(scene).expect("a world");
    let (sampler, off) = (SamplerKind::Bvh, Visibility::Off);
    let base = View::new(&camera, 20, 10).expect("a view");
    let expected = digest.identity(&world, &base, &settings(), sampler, off);
    let differs = |identity: PictureIdentity, name: &str| {
        let difference = identity.difference(&expected);
        let difference = difference.unwrap_or_else(|| panic!("{name} counts"));
        assert!(difference.starts_with(name), "{name}: {difference}");
    };
    let of_view = |view: View| digest.identity(&world, &view, &settings(), sampler, off);
    let of_camera = |camera: &Camera| of_view(View::new(camera, 20, 10).expect("a view"));
    differs(of_view(View::new(&camera, 21, 10).expect("a view")), "size");
    let crop = Crop {
        min: [0, 0],
        max: [20, 9],
    };
    differs(of_view(base.with_crop(crop).expect("a part")), "crop");
    differs(of_camera(&Camera { fov: 0.5, ..camera }), "camera");
    differs(
        of_camera(&Camera {
            lens: None,
            ..camera
        }),
        "camera",
    );
    let mut shown = Camera {
        exposure: Some(3.0),
        ..camera
    };
    shown.resolution = None;
    assert_eq!(of_camera(&shown), expected, "the exposure is for PNG files");

    let with = |change: &dyn Fn(&mut RenderSettings)| {
        let mut settings = settings();
        change(&mut settings);
        digest.identity(&world, &base, &settings, sampler, off)
    };
    differs(with(&|s| s.seed = 8), "seed 8, expected 7");
    differs(with(&|s| s.path.max_depth = 6), "depth");
    differs(with(&|s| s.path.estimator = Estimator::Light), "estimator");
    let three = NonZeroU32::new(3).expect("not 0");
    differs(with(&|s| s.path.light_samples = three), "light samples");
    differs(
        with(&|s| s.path.integrator = Integrator::VolPath),
        "integrator",
    );
    let marching = |length: f32| {
        with(&|s| {
            let step = StepSize::new(length).expect("a step");
            s.path.integrator = Integrator::SingleScattering(SingleScattering::Classic(step));
        })
    };
    assert_ne!(marching(0.5), marching(0.25), "the step");
    let other = digest.identity(&world, &base, &settings(), SamplerKind::Power, off);
    differs(other, "light sampler power, expected bvh");
    let other = digest.identity(&world, &base, &settings(), sampler, Visibility::Cells);
    differs(other, "visibility cells, expected off");
    let more = with(&|s| {
        s.samples = 4..9;
        s.time_limit = Some(Duration::from_secs(1));
    });
    assert_eq!(more, expected, "parts differ in their samples");
}
