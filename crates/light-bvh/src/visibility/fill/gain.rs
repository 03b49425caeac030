/// The second moments of one choice, by a cell and by the tree alone. They are estimated from rays
/// that the cell chose and that were not used to learn it.
///
/// A ray that was blocked adds to neither. What arrives is taken to be in proportion to the tree's
/// probability `p` where it is seen: chosen with probability `q`, the moment of the cell is the
/// mean of `p^2 / q^2`, and that of the tree the mean of `p / q`.
///
/// # Source
/// Importance sampling of both moments, `[Veach1997]`, 2.2.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gain {
    by_tree: f32,
    by_cell: f32,
}

impl Gain {
    /// Adds a light that was seen.
    pub(super) fn add(&mut self, by_tree: f32, by_cell: f32) {
        let ratio = by_tree / by_cell;
        self.by_tree += ratio;
        self.by_cell += ratio * ratio;
    }

    /// Whether the tree's moment is known to be less than `least` times that of the cell.
    pub(super) fn is_below(&self, least: f32) -> bool {
        self.by_tree < least * self.by_cell
    }
}
