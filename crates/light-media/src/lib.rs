//! light-media
