/// The most emissive triangles and quadrics in all instances of a scene: each is a light of its
/// own. This many triangles take about 8 GB where they are copied, as those of small objects and
/// all quadrics are.
pub const MAX_EMISSIVE_COPIES: usize = 1 << 25;

/// Counts the copies of emissive primitives while a file is read.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EmissiveCopies(usize);

impl EmissiveCopies {
    /// Counts `instances` instances with `emissive` triangles and quadrics each.
    ///
    /// # Errors
    /// A message with the limit, once it is exceeded.
    pub(crate) fn add(&mut self, emissive: usize, instances: usize) -> Result<(), String> {
        self.0 = self.0.saturating_add(emissive.saturating_mul(instances));
        if self.0 <= MAX_EMISSIVE_COPIES {
            return Ok(());
        }
        Err(format!(
            "expected at most {MAX_EMISSIVE_COPIES} emissive triangles and quadrics in all \
             instances, found {} so far",
            self.0
        ))
    }
}
