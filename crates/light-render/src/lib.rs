#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![warn(clippy::print_stdout, clippy::print_stderr)]

extern crate alloc;

pub use light_scene;
pub use light_sets;
pub use lights;
pub use lights::glam;

mod accel;
mod available_memory;
pub mod bench;
pub mod bsdf;
mod choice_variance;
pub mod cli;
mod compare;
mod content_digest;
mod emitter_ids;
mod exact_sum;
mod exact_sum_words;
mod false_color;
pub mod farm;
mod file_checksum;
mod film;
mod film_row;
mod flight_numbers;
mod flip;
pub mod integrator;
mod inventory;
mod light_layers;
mod light_sample_time;
mod light_sampler;
mod light_sampler_error;
mod listed_lights;
mod live;
mod partial;
mod partial_error;
mod picture_identity;
mod placed_lights;
mod placed_tree;
pub mod plot;
mod primitive_id;
mod raster;
mod ray;
mod render;
mod report;
mod sample_stream;
mod sampler_kind;
mod sampler_memory;
mod scene_bounds;
mod scene_digest;
mod scene_lights;
mod scene_lights_error;
mod shape_counts;
mod sobol;
mod source_ids;
mod surface;
mod surface_emission;
mod surface_lights;
mod tone_map;
mod view;
mod visibility;
mod world;
mod world_media;
mod world_mesh;
mod world_object;
mod world_quadric;

pub use accel::{Accel, Hit, InstanceTransform, Prototype, QuadricShape};
pub use available_memory::available_memory;
pub use compare::Comparison;
pub use exact_sum::ExactSum;
pub use false_color::difference;
pub use film::Film;
pub use film_row::FilmRow;
pub use flight_numbers::FlightNumbers;
pub use flip::Flip;
pub use inventory::{LightInventory, inventory};
pub use light_layers::{LightGroupPattern, LightLayers, LightLayersError};
pub use light_sampler::AnyLightSampler;
pub use light_sampler_error::AnyLightSamplerError;
pub use partial::PartialPicture;
pub use partial_error::PartialPictureError;
pub use picture_identity::PictureIdentity;
pub use primitive_id::PrimitiveId;
pub use ray::Ray;
pub use render::{
    LayerRendering, Progress, RenderSettings, Rendering, render, render_layers, render_while,
};
pub use sample_stream::{CameraNumbers, SampleStream, VertexNumbers};
pub use sampler_kind::SamplerKind;
pub use scene_digest::{SceneDigest, SceneDigestError};
pub use scene_lights_error::SceneLightsError;
pub use shape_counts::ShapeCounts;
pub use surface::Surface;
pub use tone_map::{ToneCurve, ToneMap};
pub use view::{View, ViewError};
pub use visibility::{
    CellLightSampler, ChoiceEstimates, ChoicePlan, PlannedLightSampler, Visibility, VisibilityCells,
};
pub use world::{World, WorldError};
