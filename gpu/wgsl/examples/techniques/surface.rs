/// Whether a pixel of the G-buffer sees a surface: it has a normal then.
pub fn is_surface(pixel: &[f32; 16]) -> bool {
    pixel[4..7] != [0.0; 3]
}
