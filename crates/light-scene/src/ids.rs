/// Position of a material in [`Scene::materials`](crate::Scene::materials).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub struct MaterialId(pub u32);

/// Position of an image in [`Scene::images`](crate::Scene::images).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub struct ImageId(pub u32);

/// Position of a prototype in [`Scene::prototypes`](crate::Scene::prototypes).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize)]
pub struct PrototypeId(pub u32);
