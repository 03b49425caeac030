//! The integration tests of light-render, as one program.

mod alpha_files;
mod alpha_lights;
mod alpha_masks;
mod bad_input;
mod closed_forms;
mod estimators;
mod flip;
mod foreign;
mod formats;
mod gltf_materials;
mod identity;
mod instances;
mod irradiance;
mod listed_lights;
mod media;
mod media_input;
mod mixtures;
mod occlusion_scenes;
mod own_lights;
mod program;
mod spheres;
mod support;
mod textured_lights;
mod visibility;
