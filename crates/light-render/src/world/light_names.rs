use alloc::borrow::Cow;

use lights::bounds::LightId;

use super::World;
use crate::inventory::kind;
use crate::listed_lights::numbered;
use crate::scene_lights::SceneSource;

impl World {
    /// The names of a light: of an emitter its material and its object, another light by its own
    /// name and its kind, or by its kind and its number. `None` for an unknown light.
    #[must_use]
    pub fn light_names(&self, light: LightId) -> Option<[Cow<'_, str>; 2]> {
        let (source, _) = self.lights.source_of(light)?;
        Some(match *self.sources.get(source.0 as usize)? {
            SceneSource::Mesh(index) => {
                let mesh = &self.meshes[index];
                [&self.materials[mesh.material].name, &mesh.name].map(Cow::from)
            }
            SceneSource::Quadric(index) => {
                let quadric = &self.quadrics[index];
                let name = &quadric.described.name;
                [&self.materials[quadric.material()].name, name].map(Cow::from)
            }
            SceneSource::Light(index) => {
                let kind = Cow::from(kind(&self.lights.get(light)?));
                match self.light_names.get(index).filter(|name| !name.is_empty()) {
                    Some(name) => [name.into(), kind],
                    None => [kind, numbered(index).into()],
                }
            }
        })
    }
}
