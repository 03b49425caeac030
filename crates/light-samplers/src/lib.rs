//! light-samplers
