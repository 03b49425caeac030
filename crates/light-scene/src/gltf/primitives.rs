use super::accessor::Accessor;
use super::item::Item;
use super::reader::Reader;
use super::uv_sets::UvSets;
use crate::glam::{Affine3A, Vec2, Vec3, Vec4};
use crate::{Diagnostic, Mesh};

/// The most triangles of a document, repeated references included.
const MOST_TRIANGLES: usize = 1 << 27;

impl<'a> Reader<'a> {
    /// The primitives of a mesh that have triangles, under `transform`.
    pub(super) fn primitives(
        &mut self,
        mesh: &Item<'a>,
        transform: &Affine3A,
    ) -> Result<Vec<Mesh>, Diagnostic> {
        let mut meshes = Vec::new();
        for primitive in mesh.list("primitives")? {
            let Some(mut triangles) = self.primitive(&primitive)? else {
                continue;
            };
            mesh.name().clone_into(&mut triangles.name);
            let mut triangles = triangles.transformed(transform);
            triangles.drop_empty_triangles();
            if !triangles.positions.iter().all(|p| p.is_finite()) {
                return Err(primitive.error("expected a transform that keeps vertices finite"));
            }
            self.triangles += triangles.indices.len();
            if self.triangles > MOST_TRIANGLES {
                let message = format!("expected at most {MOST_TRIANGLES} triangles in all");
                return Err(primitive.error(&message));
            }
            if !triangles.indices.is_empty() {
                meshes.push(triangles);
            }
        }
        Ok(meshes)
    }

    /// The triangles of a primitive, if it has any.
    fn primitive(&mut self, primitive: &Item<'a>) -> Result<Option<Mesh>, Diagnostic> {
        let mode = primitive.whole_or("mode", 4)?;
        if !matches!(mode, 4..=6) {
            self.warn(primitive, "was left out: it has no triangles");
            return Ok(None);
        }
        let attributes = primitive.require("attributes")?;
        let positions = self
            .accessor(&attributes.require("POSITION")?)?
            .floats::<3>()?;
        let count = positions.len();
        let material = self.material(primitive)?;
        let mut mesh = Mesh::new("", material.id);
        mesh.positions = positions.into_iter().map(Vec3::from).collect();
        let fits = |item: &Item<'_>, found: usize| {
            let message = format!("expected as many elements as vertices, {count}, found {found}");
            if found == count {
                Ok(())
            } else {
                Err(item.error(&message))
            }
        };
        if let Some(normals) = attributes.get("NORMAL")? {
            let all = self.accessor(&normals)?.floats::<3>()?;
            fits(&normals, all.len())?;
            mesh.normals = Some(all.into_iter().map(Vec3::from).collect());
        }
        // Without a texture the first ones are kept all the same.
        let UvSets([first, second]) = material.uv_sets;
        let sets = [Some(first.unwrap_or(0)), second];
        for (set, uvs) in sets.into_iter().zip([&mut mesh.uvs, &mut mesh.second_uvs]) {
            let name = set.map(|set| format!("TEXCOORD_{set}"));
            let found = name.map(|name| attributes.get(&name)).transpose()?;
            if let Some(found) = found.flatten() {
                let all = self.accessor(&found)?.floats::<2>()?;
                fits(&found, all.len())?;
                // Of glTF (0, 0) is the upper left corner of an image.
                let lower_left = |[u, v]: [f32; 2]| Vec2::new(u, 1.0 - v);
                *uvs = Some(all.into_iter().map(lower_left).collect());
            }
        }
        if material.normal_map_uvs.is_some() {
            if let Some(tangents) = attributes.get("TANGENT")? {
                let all = self.accessor(&tangents)?.floats::<4>()?;
                fits(&tangents, all.len())?;
                mesh.tangents = Some(all.into_iter().map(Vec4::from).collect());
            }
        }
        if let Some(colors) = attributes.get("COLOR_0")? {
            let all = self.vertex_colors(&colors, material.uses_alpha)?;
            fits(&colors, all.len())?;
            mesh.colors = Some(all);
        }
        // What no material reads has no effect.
        attributes.pass_over_members(&["TEXCOORD_", "TANGENT"]);
        let corners = match primitive.get("indices")? {
            Some(indices) => self.accessor(&indices)?.indices(count)?,
            // There are no more vertices than an accessor may hold, below 2^32.
            None => (0u32..).take(count).collect(),
        };
        mesh.indices = match mode {
            4 if corners.len() % 3 != 0 => {
                let message = format!("expected three corners a triangle, found {}", corners.len());
                return Err(primitive.error(&message));
            }
            4 => corners
                .chunks_exact(3)
                .map(|t| [t[0], t[1], t[2]])
                .collect(),
            5 => strip(&corners),
            _ => fan(&corners),
        };
        if let (Some(set), None) = (material.normal_map_uvs, &mesh.tangents) {
            mesh.generate_tangents(set);
        }
        Ok(Some(mesh))
    }

    /// Colours of vertices, without their opacity, which a warning names if the material
    /// `uses_alpha`.
    fn vertex_colors(
        &mut self,
        colors: &Item<'a>,
        uses_alpha: bool,
    ) -> Result<Vec<Vec3>, Diagnostic> {
        let accessor = self.accessor(colors)?;
        let unit = |color: Vec3| color.clamp(Vec3::ZERO, Vec3::ONE);
        if accessor.width() == 3 {
            let all = accessor.floats::<3>()?;
            return Ok(all.into_iter().map(|color| unit(color.into())).collect());
        }
        let all = accessor.floats::<4>()?;
        if uses_alpha && all.iter().any(|color| color[3] < 1.0) {
            self.warn(colors, "has opacities that were ignored");
        }
        let color = |[r, g, b, _]: [f32; 4]| unit(Vec3::new(r, g, b));
        Ok(all.into_iter().map(color).collect())
    }

    fn accessor(&mut self, reference: &Item<'a>) -> Result<Accessor<'a>, Diagnostic> {
        Accessor::new(reference, &self.buffers, &mut self.budget)
    }
}

/// Each corner with the two before it; every second triangle runs the other way around.
fn strip(corners: &[u32]) -> Vec<[u32; 3]> {
    let triangles = corners.windows(3).enumerate();
    triangles
        .map(|(i, t)| {
            if i % 2 == 0 {
                [t[0], t[1], t[2]]
            } else {
                [t[0], t[2], t[1]]
            }
        })
        .collect()
}

/// Each edge with the first corner.
fn fan(corners: &[u32]) -> Vec<[u32; 3]> {
    let Some((&first, rim)) = corners.split_first() else {
        return Vec::new();
    };
    rim.windows(2)
        .map(|edge| [first, edge[0], edge[1]])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_turn_every_second_triangle() {
        assert_eq!(strip(&[7, 8, 9, 3]), [[7, 8, 9], [8, 3, 9]], "strip");
        assert_eq!(fan(&[7, 8, 9, 3]), [[7, 8, 9], [7, 9, 3]], "fan");
        assert!(strip(&[1, 2]).is_empty() && fan(&[]).is_empty(), "none");
    }
}
