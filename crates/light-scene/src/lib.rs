//! light-scene
