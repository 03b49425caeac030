/// The shortest wavelength, in nm.
pub const LAMBDA_MIN: f32 = 360.0;

/// The longest wavelength, in nm.
pub const LAMBDA_MAX: f32 = 830.0;
