//! light-scene

pub mod light_set;
