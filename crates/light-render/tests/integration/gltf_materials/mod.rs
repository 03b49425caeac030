//! Surfaces as glTF describes them: metalness and roughness by texel, normal maps, colours of
//! vertices, back faces, second texture coordinates.

mod back_faces;
mod files;
mod normal_maps;
mod scenes;
mod surfaces;
