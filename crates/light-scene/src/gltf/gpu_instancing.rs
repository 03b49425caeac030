use super::accessor::Accessor;
use super::item::Item;
use super::reader::Reader;
use crate::Diagnostic;
use crate::glam::{Affine3A, Quat, Vec3};

/// The most instances that a document may place by the extension in all.
const MOST_INSTANCES: usize = 1 << 20;

impl<'a> Reader<'a> {
    /// Where `EXT_mesh_gpu_instancing` places the mesh of a node, from the node's own space; `None`
    /// for a node without it.
    pub(super) fn placements(
        &mut self,
        node: &Item<'a>,
    ) -> Result<Option<Vec<Affine3A>>, Diagnostic> {
        let Some(extension) = node.extension("EXT_mesh_gpu_instancing")? else {
            return Ok(None);
        };
        let attributes = extension.require("attributes")?;
        // Of applications, as numbers of the instances.
        attributes.pass_over_members(&["_"]);
        let translations = self.attribute::<3>(&attributes, "TRANSLATION")?;
        let rotations = self.attribute::<4>(&attributes, "ROTATION")?;
        let scales = self.attribute::<3>(&attributes, "SCALE")?;
        let counts = [
            translations.as_ref().map(Vec::len),
            rotations.as_ref().map(Vec::len),
            scales.as_ref().map(Vec::len),
        ];
        let mut counts = counts.into_iter().flatten();
        let count = counts.next().ok_or_else(|| {
            attributes.error("expected a member `TRANSLATION`, `ROTATION` or `SCALE`")
        })?;
        if counts.any(|other| other != count) {
            return Err(attributes.error("expected attributes of as many elements each"));
        }
        self.placed = self.placed.saturating_add(count);
        if self.placed > MOST_INSTANCES {
            let message = format!("expected at most {MOST_INSTANCES} instances in all");
            return Err(attributes.error(&message));
        }
        let at = |i: usize| {
            let rotation = rotations
                .as_ref()
                .map_or(Quat::IDENTITY, |all| Quat::from_array(all[i]));
            if !(rotation.length() > 0.5 && rotation.length() < 2.0) {
                let message = format!("element {i} of `ROTATION`: expected a length of 1");
                return Err(attributes.error(&message));
            }
            Ok(Affine3A::from_scale_rotation_translation(
                scales.as_ref().map_or(Vec3::ONE, |all| Vec3::from(all[i])),
                rotation.normalize(),
                translations
                    .as_ref()
                    .map_or(Vec3::ZERO, |all| Vec3::from(all[i])),
            ))
        };
        (0..count).map(at).collect::<Result<_, _>>().map(Some)
    }

    /// The elements of an attribute, if it is there.
    fn attribute<const N: usize>(
        &mut self,
        attributes: &Item<'a>,
        name: &str,
    ) -> Result<Option<Vec<[f32; N]>>, Diagnostic> {
        let Some(reference) = attributes.get(name)? else {
            return Ok(None);
        };
        let accessor = Accessor::new(&reference, &self.buffers, &mut self.budget)?;
        accessor.floats().map(Some)
    }
}
