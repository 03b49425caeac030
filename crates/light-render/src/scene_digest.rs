use core::error::Error;
use core::fmt;

use light_scene::{Camera, Crop, Scene};
use lights::sources::LightDesc;

use crate::content_digest::content_digest;
use crate::integrator::PathSettings;
use crate::{PictureIdentity, RenderSettings, SamplerKind, View, Visibility, World};

/// The layout of files with parts of pictures, and the rules by which samples are made: one that
/// changes makes other pictures.
const FORMAT: u32 = 4;

/// Digests of what a picture depends on and the world of a scene does not keep as it was described:
/// lights without a surface, and media. Taken before the scene becomes a world.
///
/// The rest is most of a scene, and the world keeps it: [`identity`](Self::identity) takes its
/// digests when they are needed.
#[derive(Clone, Debug)]
pub struct SceneDigest([(&'static str, String); 2]);

/// Why a scene has no digest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneDigestError {
    /// A light is of a type of the caller's own, so that its content is unknown.
    OwnLight {
        /// Its position among the scene's lights.
        light: usize,
    },
}

impl SceneDigest {
    /// The digests of a scene: everything about a light or a medium counts.
    ///
    /// # Errors
    /// When the scene has an own light.
    pub fn new(scene: &Scene) -> Result<Self, SceneDigestError> {
        // No field may be left out unseen, so that each is named.
        let Scene {
            // The world knows these.
            meshes: _,
            quadrics: _,
            prototypes: _,
            instances: _,
            materials: _,
            images: _,
            lights,
            // They say nothing about the picture, as long as it has no layers.
            light_names: _,
            has_black_lights: _,
            media,
            // The view knows it, with what the command line changes.
            camera: _,
            camera_medium,
            // The settings know it, with what the command line changes.
            max_depth: _,
            samples_per_pixel: _,
            // They may name files by other paths on other machines, and say nothing about the
            // picture.
            warnings: _,
        } = scene;
        let is_own = |light: &LightDesc<_>| matches!(light, LightDesc::Own(_));
        if let Some(light) = lights.iter().position(is_own) {
            return Err(SceneDigestError::OwnLight { light });
        }
        Ok(Self([
            ("lights", content_digest(lights)),
            ("media", content_digest(&(media, camera_medium))),
        ]))
    }

    /// The identity of the picture of `view` of the scene that became `world`, rendered with
    /// `sampler`, `visibility` and `settings`. Takes time in proportion to the geometry and images
    /// of the world: every vertex, material and texel counts.
    #[must_use]
    pub fn identity(
        &self,
        world: &World,
        view: &View,
        settings: &RenderSettings,
        sampler: SamplerKind,
        visibility: Visibility,
    ) -> PictureIdentity {
        let RenderSettings {
            // Parts differ in these two.
            samples: _,
            time_limit: _,
            seed,
            path,
        } = settings;
        let PathSettings {
            max_depth,
            estimator,
            light_samples,
            integrator,
        } = path;
        let Crop { min, max } = view.crop();
        let [(x0, y0), (x1, y1)] = [min, max].map(|[x, y]| (x, y));
        let (width, height) = view.resolution();
        let version = format!("{FORMAT} of lights {}", env!("CARGO_PKG_VERSION"));
        let Self(scene) = self;
        let scene = scene.iter().map(|(name, digest)| (*name, digest.clone()));
        let scene = world.digests().into_iter().chain(scene);
        let rest = [
            ("format", version),
            ("camera", camera_digest(view.camera())),
            ("size", format!("{width} x {height}")),
            ("crop", format!("{x0},{y0} to {x1},{y1}")),
            ("seed", seed.to_string()),
            ("depth", max_depth.to_string()),
            ("estimator", format!("{estimator:?}")),
            ("light samples", light_samples.to_string()),
            ("integrator", format!("{integrator:?}")),
            ("light sampler", sampler.name().to_owned()),
            ("visibility", visibility.name().to_owned()),
        ];
        PictureIdentity::new(scene.chain(rest))
    }
}

/// The digest of the camera: the origins and directions of its rays.
fn camera_digest(camera: &Camera) -> String {
    let Camera {
        position,
        right,
        up,
        forward,
        projection,
        fov,
        screen,
        lens,
        // The view's size and crop count.
        resolution: _,
        crop: _,
        // It says how the picture is shown.
        exposure: _,
    } = camera;
    let axes = (position, right, up, forward);
    content_digest(&(axes, projection, fov, screen, lens))
}

impl fmt::Display for SceneDigestError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::OwnLight { light } = self;
        write!(f, "light {light}: an own light has no digest")
    }
}

impl Error for SceneDigestError {}
