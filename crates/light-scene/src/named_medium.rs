use lights::media::AnyMedium;
use lights::sources::Rgb;

/// A medium of a scene: fog, smoke, a flame. Its constructors have checked it.
#[derive(Clone, Debug, serde::Serialize)]
pub struct NamedMedium {
    /// The name in the file.
    pub name: String,
    /// What it is.
    pub medium: AnyMedium<Rgb>,
}
