//! A light that is given in lumens, candelas, nits or lux emits that amount, in both colour models.

mod by_illuminance;
mod by_intensity;
mod by_radiance;
mod model;
