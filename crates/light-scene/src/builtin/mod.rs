//! Scenes that ship with the crate.

mod cornell;
mod dice;
mod fog;
mod modeller;
mod night;
mod rotunda;

use core::fmt;
use core::str::FromStr;

use crate::Scene;

/// A scene that ships with the crate: made by its code and by files that it holds, so that no
/// download is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BuiltinScene {
    /// Two blocks in a coloured room under one lamp; the classic test, from its published
    /// measurements.
    CornellBox,
    /// A wood in fog with a thousand lamps among its trunks.
    Fog,
    /// A town canal by night: twenty thousand small lights, most of them hidden from any one point.
    Night,
    /// Columns in still water around four spheres, under a photographed sky.
    Rotunda,
}

impl BuiltinScene {
    /// All scenes, from the simplest on.
    pub const ALL: [Self; 4] = [Self::CornellBox, Self::Rotunda, Self::Fog, Self::Night];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::CornellBox => "cornell-box",
            Self::Fog => "fog",
            Self::Night => "night",
            Self::Rotunda => "rotunda",
        }
    }

    /// Makes the scene; the same one each time.
    #[must_use]
    pub fn load(self) -> Scene {
        match self {
            Self::CornellBox => cornell::cornell_box(),
            Self::Fog => fog::fog(FOG_SEED),
            Self::Night => night::night(NIGHT_SEED),
            Self::Rotunda => rotunda::rotunda(),
        }
    }
}

impl fmt::Display for BuiltinScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The wood that ships.
const FOG_SEED: u64 = 1;

/// The night that ships.
const NIGHT_SEED: u64 = 1;

/// A name that no scene that ships has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownScene;

impl fmt::Display for UnknownScene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("expected a scene that ships:")?;
        BuiltinScene::ALL
            .iter()
            .try_for_each(|scene| write!(f, " {scene}"))
    }
}

impl core::error::Error for UnknownScene {}

impl FromStr for BuiltinScene {
    type Err = UnknownScene;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let mut scenes = Self::ALL.into_iter();
        scenes
            .find(|scene| scene.name() == name)
            .ok_or(UnknownScene)
    }
}
