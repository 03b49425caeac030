use super::at::At;
use super::object_slots::{ObjectSlot, Objects, OpenObject};
use super::state::{Reader, State};
use crate::glam::Affine3A;
use crate::text::shown;
use crate::{Diagnostic, Mesh, Placement, Prototype, Sphere};

/// Triangles that a scene may hold, however often it names the same files.
const MOST_TRIANGLES: usize = 1 << 27;

impl Reader {
    /// `ObjectBegin "name"`: what follows stands nowhere yet.
    pub(super) fn object_begin(&mut self, at: At<'_>, name: &str) -> Result<(), Diagnostic> {
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

    pub(super) fn object_end(&mut self, at: At<'_>) -> Result<(), Diagnostic> {
        let open = self.objects.open.take();
        let open = open.ok_or_else(|| at.unmatched("ObjectBegin"))?;
        if self.saved.len() > open.depth {
            return Err(at.unmatched("AttributeEnd"));
        }
        let slot = &mut self.objects.slots[open.id.0 as usize];
        slot.shining = self.scene.shining_count(&open.prototype);
        slot.prototype = Some(open.prototype);
        let (shining, places) = (slot.shining, slot.places);
        let copies = self.objects.copies.add(shining, places);
        copies.map_err(|message| at.diagnostic(message))?;
        let saved = self.saved.pop();
        self.state = saved.ok_or_else(|| at.unmatched("ObjectBegin"))?.state;
        Ok(())
    }

    /// `ObjectInstance "name"`: the transform in force acts on top of those that the object was
    /// described with.
    pub(super) fn object_instance(&mut self, at: At<'_>, name: &str) -> Result<(), Diagnostic> {
        if self.objects.open.is_some() {
            return Err(at.diagnostic("expected `ObjectEnd` before `ObjectInstance`"));
        }
        let prototype = self.objects.id(at, name);
        let slot = &mut self.objects.slots[prototype.0 as usize];
        slot.places += 1;
        let shining = slot.shining;
        let copies = self.objects.copies.add(shining, 1);
        copies.map_err(|message| at.diagnostic(message))?;
        let place = Affine3A::from_mat4(self.state.transform);
        self.scene.placements.push(Placement { prototype, place });
        Ok(())
    }

    /// The state that `AttributeEnd` goes back to, unless it belongs to an object.
    pub(super) fn saved_state(&mut self) -> Option<State> {
        let open = self.objects.open.as_ref();
        let kept = open.map_or(0, |open| open.depth);
        let saved = (self.saved.len() > kept).then(|| self.saved.pop())?;
        saved.map(|saved| saved.state)
    }

    /// A mesh of the world, or of the object that is being described.
    pub(super) fn add_mesh(&mut self, at: At<'_>, mesh: Mesh) -> Result<(), Diagnostic> {
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

    /// A sphere of the world, or of the object that is being described.
    pub(super) fn add_sphere(&mut self, sphere: Sphere) {
        match &mut self.objects.open {
            Some(open) => open.prototype.spheres.push(sphere),
            None => self.scene.spheres.push(sphere),
        }
    }

    /// All objects, in the order of their ids, once everything is read.
    pub(super) fn finished_objects(&mut self) -> Result<Vec<Prototype>, Diagnostic> {
        let Objects { slots, .. } = core::mem::take(&mut self.objects);
        let described = |slot: ObjectSlot| slot.prototype.ok_or(slot.unknown);
        slots.into_iter().map(described).collect()
    }
}
