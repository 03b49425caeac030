/// How many triangles and spheres that shine may stand in all places of objects: each is a light of
/// its own, so that it is copied. So many triangles take about 8 GB.
pub const MOST_SHINING_COPIES: usize = 1 << 25;

/// Counts what will be copied while a file is read.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ShiningCopies(usize);

impl ShiningCopies {
    /// Counts `shining` triangles and spheres in so many `places`.
    ///
    /// # Errors
    /// What to say when these are too many.
    pub(crate) fn add(&mut self, shining: usize, places: usize) -> Result<(), String> {
        self.0 = self.0.saturating_add(shining.saturating_mul(places));
        if self.0 <= MOST_SHINING_COPIES {
            return Ok(());
        }
        Err(format!(
            "expected at most {MOST_SHINING_COPIES} triangles and spheres that shine in all places of objects, found {} so far",
            self.0
        ))
    }
}
