//! The integration tests of light-media, as one program.

mod closed_forms;
mod convergence;
mod defaults;
mod edges;
mod extreme_media;
mod kinds_of_media;
mod lights_in_media;
mod next_event;
mod no_light;
mod own_lights;
mod phase_mis;
mod support;
mod trackers;
