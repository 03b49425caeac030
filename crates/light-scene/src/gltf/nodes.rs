use super::item::Item;
use super::reader::Reader;
use crate::glam::{Affine3A, Mat4, Quat, Vec3};
use crate::{Camera, Diagnostic};

impl<'a> Reader<'a> {
    /// Visits the nodes of the document's scene, with their transforms.
    pub(super) fn nodes(&mut self) -> Result<(), Diagnostic> {
        let root = self.document.root();
        let nodes = root.list("nodes")?;
        let mut parented = vec![false; nodes.len()];
        // The last one is next.
        let mut waiting: Vec<(Item<'a>, Affine3A)> = Vec::new();
        for start in self.start(&nodes)?.into_iter().rev() {
            waiting.push((start, Affine3A::IDENTITY));
        }
        while let Some((reference, parent)) = waiting.pop() {
            let (index, node) = reference.target("nodes")?;
            if core::mem::replace(&mut parented[index], true) {
                return Err(reference.expected("a node that hangs nowhere else"));
            }
            let transform = parent * local(&node)?;
            if !transform.is_finite() {
                return Err(node.error("expected a finite transform"));
            }
            self.node(&node, &transform)?;
            let children = node.list("children")?;
            waiting.extend(children.into_iter().rev().map(|child| (child, transform)));
        }
        Ok(())
    }

    /// References to the nodes that the scene starts from.
    fn start(&self, nodes: &[Item<'a>]) -> Result<Vec<Item<'a>>, Diagnostic> {
        let root = self.document.root();
        if let Some(scene) = root.get("scene")? {
            return scene.target("scenes")?.1.list("nodes");
        }
        if let Some(first) = root.list("scenes")?.first() {
            return first.list("nodes");
        }
        let none = || root.error("expected a member `scene` or `scenes`");
        if nodes.is_empty() {
            Ok(Vec::new())
        } else {
            Err(none())
        }
    }

    fn node(&mut self, node: &Item<'a>, transform: &Affine3A) -> Result<(), Diagnostic> {
        if let Some(camera) = node.get("camera")? {
            let (_, described) = camera.target("cameras")?;
            if self.scene.camera.is_some() {
                self.warn(&camera, "was ignored: an earlier camera looks");
            } else {
                self.scene.camera = self.camera(&described, transform)?;
            }
        }
        self.lights(node, transform)?;
        let Some(mesh) = node.get("mesh")? else {
            return Ok(());
        };
        let (index, mesh) = mesh.target("meshes")?;
        if let Some(placements) = self.placements(node)? {
            for placement in placements {
                self.show(node, (index, &mesh), transform * placement)?;
            }
            return Ok(());
        }
        self.show(node, (index, &mesh), *transform)
    }

    /// Puts a mesh where a node shows it.
    fn show(
        &mut self,
        node: &Item<'a>,
        (index, mesh): (usize, &Item<'a>),
        transform: Affine3A,
    ) -> Result<(), Diagnostic> {
        if !transform.is_finite() {
            return Err(node.error("expected instances with finite transforms"));
        }
        if transform.matrix3.determinant() == 0.0 {
            self.warn(node, "was left out: its transform makes its mesh flat");
            return Ok(());
        }
        self.uses.add(index, mesh.clone(), node.clone(), transform);
        Ok(())
    }

    fn camera(
        &mut self,
        camera: &Item<'a>,
        transform: &Affine3A,
    ) -> Result<Option<Camera>, Diagnostic> {
        let Some(perspective) = camera.get("perspective")? else {
            self.warn(camera, "was ignored: it has no perspective");
            return Ok(None);
        };
        camera.get("type")?;
        // The clipping distances of rasterisers.
        ["znear", "zfar"]
            .map(|name| perspective.get(name))
            .into_iter()
            .collect::<Result<Vec<_>, _>>()?;
        let vertical = perspective.require("yfov")?;
        let tan = (0.5 * vertical.number()?).tan();
        let aspect = perspective.amount_or("aspectRatio", 1.0)?.min(1.0);
        // This crate uses that of the shorter side.
        let fov = 2.0 * (tan * aspect).atan();
        let position = Vec3::from(transform.translation);
        let [forward, up] = [Vec3::NEG_Z, Vec3::Y].map(|axis| transform.transform_vector3(axis));
        let camera = Camera::look_at(position, position + forward.normalize_or_zero(), up, fov);
        camera
            .map(Some)
            .map_err(|error| perspective.error(&error.to_string()))
    }
}

/// From a node to its parent.
fn local(node: &Item<'_>) -> Result<Affine3A, Diagnostic> {
    if let Some(matrix) = node.get("matrix")? {
        let columns = matrix.numbers()?;
        let matrix4 = Mat4::from_cols_array(&columns);
        if matrix4.row(3).to_array() != [0.0, 0.0, 0.0, 1.0] {
            return Err(matrix.error("expected a last row of 0 0 0 1"));
        }
        return Ok(Affine3A::from_mat4(matrix4));
    }
    let scale = Vec3::from(node.numbers_or("scale", [1.0; 3])?);
    let rotation = Quat::from_array(node.numbers_or("rotation", [0.0, 0.0, 0.0, 1.0])?);
    if !(rotation.length() > 0.5 && rotation.length() < 2.0) {
        return Err(node.error("expected a `rotation` of length 1"));
    }
    let translation = Vec3::from(node.numbers_or("translation", [0.0; 3])?);
    let rotation = rotation.normalize();
    Ok(Affine3A::from_scale_rotation_translation(
        scale,
        rotation,
        translation,
    ))
}
