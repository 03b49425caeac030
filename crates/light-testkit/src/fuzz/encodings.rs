use super::compact_bounds::compact_bounds;
use super::distributions::distributions;
use super::octahedral::octahedral;
use super::quantisation::{box_quantisation, cosine_quantisation};

/// Codes of boxes, cosines, bounds and directions, and tables of weights; the first byte chooses
/// which.
///
/// # Panics
/// If a guarantee is violated.
pub fn encodings(data: &[u8]) {
    let Some((kind, data)) = data.split_first() else {
        return;
    };
    match kind % 5 {
        0 => box_quantisation(data),
        1 => compact_bounds(data),
        2 => cosine_quantisation(data),
        3 => distributions(data),
        _ => octahedral(data),
    }
}
