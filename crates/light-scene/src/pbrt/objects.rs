use lights::math::Aabb;

use super::file_loc::FileLoc;
use super::object_slots::{ObjectSlot, Objects, OpenObject};
use super::state::{FLATTENED, Reader, State};
use crate::glam::Affine3A;
use crate::text::shown;
use crate::{Diagnostic, Instance, Mesh, Prototype, Quadric};

/// The most triangles that a scene may store, also if it includes the same files many times.
const MOST_TRIANGLES: usize = 1 << 27;

impl Reader {
    /// `ObjectBegin "name"`: the shapes that follow belong to a prototype.
    pub(super) fn object_begin(&mut self, at: FileLoc<'_>, name: &str) -> Result<(), Diagnostic> {
        if self.objects.open.is_some() {
            return Err(at.diagnostic("expected `ObjectEnd` before another `ObjectBegin`"));
        }
        let id = self.objects.id(at, name);
        if self.objects.slots[id.0 as usize].prototype.is_some() {
            let message = format!("expected one object \"{}\", found another", shown(name));
            return Err(at.diagnostic(message));
        }
        self.save_state(at, "expected `ObjectEnd` after `ObjectBegin`")?;
        self.objects.open = Some(OpenObject {
            id,
            prototype: Prototype::new(name, Vec::new()),
            depth: self.saved.len(),
        });
        Ok(())
    }

    pub(super) fn object_end(&mut self, at: FileLoc<'_>) -> Result<(), Diagnostic> {
        let open = self.objects.open.take();
        let open = open.ok_or_else(|| at.unmatched("ObjectBegin"))?;
        if self.saved.len() > open.depth {
            return Err(at.unmatched("AttributeEnd"));
        }
        let slot = &mut self.objects.slots[open.id.0 as usize];
        slot.emissive = self.scene.emissive_count(&open.prototype);
        slot.prototype = Some(open.prototype);
        let (emissive, instances) = (slot.emissive, slot.instances);
        let copies = self.objects.copies.add(emissive, instances);
        copies.map_err(|message| at.diagnostic(message))?;
        let saved = self.saved.pop();
        self.state = saved.ok_or_else(|| at.unmatched("ObjectBegin"))?.state;
        Ok(())
    }

    /// `ObjectInstance "name"`: the current transform is applied after those of the object's
    /// definition.
    pub(super) fn object_instance(
        &mut self,
        at: FileLoc<'_>,
        name: &str,
    ) -> Result<(), Diagnostic> {
        if self.objects.open.is_some() {
            return Err(at.diagnostic("expected `ObjectEnd` before `ObjectInstance`"));
        }
        if self.state.is_singular() {
            self.warn(at, "`ObjectInstance`", FLATTENED);
            return Ok(());
        }
        let prototype = self.objects.id(at, name);
        let slot = &mut self.objects.slots[prototype.0 as usize];
        slot.instances += 1;
        let emissive = slot.emissive;
        let copies = self.objects.copies.add(emissive, 1);
        copies.map_err(|message| at.diagnostic(message))?;
        let transform = Affine3A::from_mat4(self.state.transform);
        self.scene.instances.push(Instance {
            prototype,
            transform,
        });
        Ok(())
    }

    /// The state that `AttributeEnd` restores, unless it belongs to an object.
    pub(super) fn saved_state(&mut self) -> Option<State> {
        let open = self.objects.open.as_ref();
        let kept = open.map_or(0, |open| open.depth);
        let saved = (self.saved.len() > kept).then(|| self.saved.pop())?;
        saved.map(|saved| saved.state)
    }

    /// Adds a mesh to the object that is being defined, or to the world.
    pub(super) fn add_mesh(&mut self, at: FileLoc<'_>, mesh: Mesh) -> Result<(), Diagnostic> {
        self.triangles = self.triangles.saturating_add(mesh.indices.len());
        if self.triangles > MOST_TRIANGLES {
            let message = format!("expected at most {MOST_TRIANGLES} triangles in all");
            return Err(at.diagnostic(message));
        }
        match &mut self.objects.open {
            Some(open) => open.prototype.meshes.push(mesh),
            None => self.scene.meshes.push(mesh),
        }
        Ok(())
    }

    /// Adds a quadric to the object that is being defined, or to the world.
    pub(super) fn add_quadric(&mut self, quadric: Quadric) {
        match &mut self.objects.open {
            Some(open) => open.prototype.quadrics.push(quadric),
            None => self.scene.quadrics.push(quadric),
        }
    }

    /// Adds an object without a name, which emits nothing, in one place; its box there.
    pub(super) fn add_single_instance(
        &mut self,
        at: FileLoc<'_>,
        prototype: Prototype,
        transform: Affine3A,
    ) -> Aabb {
        let boxes = prototype.boxes();
        let prototype = self.objects.add(at, "", Some(prototype));
        let instance = Instance {
            prototype,
            transform,
        };
        let bounds = instance.bounds(&boxes);
        self.scene.instances.push(instance);
        bounds
    }

    /// All objects, in the order of their ids, after the last directive.
    pub(super) fn finished_objects(&mut self) -> Result<Vec<Prototype>, Diagnostic> {
        let Objects { slots, .. } = core::mem::take(&mut self.objects);
        let described = |slot: ObjectSlot| slot.prototype.ok_or(slot.unknown);
        slots.into_iter().map(described).collect()
    }
}
