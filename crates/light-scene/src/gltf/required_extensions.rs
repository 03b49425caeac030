/// What a reader does with an extension that a document requires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Required {
    /// It reads it.
    Read,
    /// It leaves it out: materials, images, lights and animations change how a scene looks, not
    /// what is there.
    Looks,
    /// It cannot unpack its meshes; a tool can.
    Compressed,
    /// It cannot say what is there.
    Unknown,
}

/// Extensions that are read.
const READ: [&str; 10] = [
    "EXT_lights_ies",
    "EXT_mesh_gpu_instancing",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// The words behind the vendor's of extensions that only affect looks.
const LOOKS: [&str; 8] = [
    "animation",
    "audio",
    "environments",
    "interactivity",
    "lights",
    "materials",
    "texture",
    "xmp",
];

/// Extensions that compress meshes.
const COMPRESSED: [&str; 3] = [
    "EXT_meshopt_compression",
    "KHR_draco_mesh_compression",
    "KHR_meshopt_compression",
];

/// What unpacks compressed meshes.
pub(super) const UNPACK: &str = "; `gltf-transform copy compressed.glb plain.glb` unpacks meshes";

/// What becomes of the required extension `name`.
pub(super) fn required(name: &str) -> Required {
    if READ.contains(&name) {
        return Required::Read;
    }
    if COMPRESSED.contains(&name) {
        return Required::Compressed;
    }
    let mut words = name.split('_').skip(1);
    match words.next() {
        Some(word) if LOOKS.contains(&word) => Required::Looks,
        _ => Required::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_are_told_from_geometry() {
        for (name, expected) in [
            ("KHR_texture_transform", Required::Read),
            ("KHR_materials_unlit", Required::Looks),
            ("KHR_materials_pbrSpecularGlossiness", Required::Looks),
            ("EXT_texture_webp", Required::Looks),
            ("KHR_texture_basisu", Required::Looks),
            ("KHR_animation_pointer", Required::Looks),
            ("KHR_draco_mesh_compression", Required::Compressed),
            ("EXT_meshopt_compression", Required::Compressed),
            ("EXT_mesh_gpu_instancing", Required::Read),
            ("EXT_mesh_manifold", Required::Unknown),
            ("materials", Required::Unknown),
        ] {
            assert_eq!(required(name), expected, "{name}");
        }
    }
}
