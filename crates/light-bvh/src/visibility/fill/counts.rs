use crate::node::wide_node::WIDTH;

/// Rays to the lights of a child, and how many of them were not blocked.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub(super) rays: u32,
    pub(super) seen: u32,
}

/// The counts of all children of a node.
pub(super) type NodeCounts = [Counts; WIDTH];

impl Counts {
    pub(super) fn add(&mut self, is_seen: bool) {
        self.rays += 1;
        self.seen += u32::from(is_seen);
    }

    /// The expected visible share. `before`, the share expected without these rays, counts as one
    /// ray.
    pub(super) fn visibility(self, before: f32) -> f32 {
        (self.seen as f32 + before) / (self.rays as f32 + 1.0)
    }

    /// How much opening the child can gain: large if many of its lights are seen and some are not,
    /// 0 if all or none are seen.
    pub(super) fn open_score(self) -> u32 {
        const LEAST: u32 = 6;
        if self.rays < LEAST {
            return 0;
        }
        self.seen.min(4 * (self.rays - self.seen))
    }
}
