use std::path::Path;

use crate::Diagnostic;

/// The most texels of all images of a scene: 6 GiB of memory, 32 images of 4096 by 4096. Tests use
/// a smaller limit.
pub(crate) const MOST_TEXELS: u64 = if cfg!(test) { 1 << 22 } else { 1 << 29 };

/// The number of texels of a scene's images so far.
#[derive(Debug, Default)]
pub(crate) struct TexelBudget(u64);

impl TexelBudget {
    /// Counts the texels of a file's image.
    ///
    /// # Errors
    /// When the scene has more than [`MOST_TEXELS`] then.
    pub(crate) fn take(
        &mut self,
        path: &Path,
        [width, height]: [u32; 2],
    ) -> Result<(), Diagnostic> {
        self.0 = self.0.saturating_add(u64::from(width) * u64::from(height));
        if self.0 > MOST_TEXELS {
            let message = format!("expected at most {MOST_TEXELS} texels in all images together");
            return Err(Diagnostic::file(path, message));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::tests::png;
    use crate::test_folder::TestFolder;
    use crate::{read_gltf, read_obj, read_pbrt};
    use std::fs;

    /// Each of two images has less than the most, both together have more: every reader refuses the
    /// second by its name.
    #[test]
    fn images_count_together() {
        let folder = TestFolder::new("texel_budget");
        let image = png(::image::GrayImage::new(2048, 1025));
        let write = |name: &str, text: &str| {
            let path = folder.path(name);
            fs::write(&path, text).expect("written");
            path
        };
        for name in ["a.png", "b.png"] {
            fs::write(folder.path(name), &image).expect("written");
        }
        let most = format!("expected at most {MOST_TEXELS} texels in all images together");
        let assert_refused = |error: Diagnostic, what: &str| {
            let error = error.to_string();
            assert!(error.contains(what) && error.ends_with(&most), "{error}");
        };

        let materials =
            |second: &str| format!("newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd {second}\n");
        let obj = write(
            "a.obj",
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
        );
        write("a.mtl", &materials("a.png"));
        read_obj(&obj).expect("one image, twice");
        write("a.mtl", &materials("b.png"));
        assert_refused(read_obj(&obj).expect_err("two images"), "b.png");

        let texture = |name: &str| {
            format!(
                "Texture \"{name}\" \"spectrum\" \"imagemap\" \"string filename\" \"{name}.png\"\n"
            )
        };
        let one = format!("WorldBegin\n{}", texture("a"));
        read_pbrt(&write("a.pbrt", &one)).expect("one image");
        let light = "LightSource \"infinite\" \"string filename\" \"b.png\"";
        for second in [&texture("b"), light] {
            let two = write("b.pbrt", &format!("{one}{second}"));
            assert_refused(read_pbrt(&two).expect_err("two images"), "b.png");
        }

        let document = |second: u32| {
            format!(
                r#"{{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0]}}],
                "nodes": [{{"mesh": 0}}], "meshes": [{{"primitives": [{}, {}]}}],
                "bufferViews": [{{"buffer": 0, "byteLength": 60}}],
                "accessors": [
                    {{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                        "min": [0, 0, 0], "max": [1, 1, 0]}},
                    {{"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3,
                        "type": "VEC2"}}],
                "buffers": [{{"byteLength": 60, "uri": "a.bin"}}],
                "materials": [{}, {}], "textures": [{{"source": 0}}, {{"source": 1}}],
                "images": [{{"uri": "a.png"}}, {{"uri": "b.png"}}]}}"#,
                primitive(0),
                primitive(second),
                material(0),
                material(1),
            )
        };
        let numbers = [
            0.0f32, 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 1.,
        ];
        let bytes = numbers.map(f32::to_le_bytes).concat();
        fs::write(folder.path("a.bin"), bytes).expect("written");
        read_gltf(&write("a.gltf", &document(0))).expect("one image, twice");
        let two = write("b.gltf", &document(1));
        assert_refused(read_gltf(&two).expect_err("two images"), "images[1]");
    }

    fn primitive(material: u32) -> String {
        format!(r#"{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": {material}}}"#)
    }

    fn material(texture: u32) -> String {
        format!(
            r#"{{"pbrMetallicRoughness": {{"metallicFactor": 0,
                "baseColorTexture": {{"index": {texture}}}}}}}"#
        )
    }
}
