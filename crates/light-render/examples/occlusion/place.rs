use core::error::Error;
use core::fmt;
use core::str::FromStr;

use light_render::{View, World};
use light_scene::{BuiltinScene, OcclusionKind, OcclusionScene};

use super::gloss::Gloss;

/// A built-in scene, or one generated with another seed or number of lamps.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    Builtin(BuiltinScene),
    Generated(OcclusionScene),
}

/// The scenes that are measured by default.
pub(super) fn occluded() -> Vec<Place> {
    let is_occluded = |scene: &BuiltinScene| matches!(scene, BuiltinScene::Occlusion(..));
    let scenes = BuiltinScene::ALL.into_iter();
    scenes.filter(is_occluded).map(Place::Builtin).collect()
}

impl FromStr for Place {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Ok(scene) = text.parse() {
            return Ok(Self::Builtin(scene));
        }
        let mut words = text.split(':');
        let mut next = || words.next().unwrap_or_default();
        let (kind, lamps, seed) = (next(), next(), next());
        let kind = OcclusionKind::ALL
            .into_iter()
            .find(|k| k.to_string() == kind);
        let scene = match (kind, lamps.parse(), seed.parse()) {
            (Some(kind), Ok(lamps), Ok(seed)) => OcclusionScene { kind, lamps, seed },
            _ => return Err("expected a built-in scene or KIND:LAMPS:SEED"),
        };
        Ok(Self::Generated(scene))
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Builtin(scene) => scene.fmt(f),
            Self::Generated(OcclusionScene { kind, lamps, seed }) => {
                write!(f, "{kind}:{lamps}:{seed}")
            }
        }
    }
}

/// A scene, seen by its camera.
pub(super) fn load(
    scene: Place,
    gloss: Option<Gloss>,
    (width, height): (u32, u32),
) -> Result<(World, View), Box<dyn Error>> {
    let mut scene = match scene {
        Place::Builtin(scene) => scene.load(),
        Place::Generated(scene) => scene.load(),
    };
    if let Some(gloss) = gloss {
        scene.materials.iter_mut().for_each(|m| gloss.apply(m));
    }
    let view = View::new(&scene.camera_or_default(), width, height)?;
    Ok((World::new(scene)?, view))
}
