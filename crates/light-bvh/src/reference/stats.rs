use super::ReferenceLightBvhRef;

/// How large and how deep a tree is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceStats {
    /// Lights in the tree.
    pub lights: usize,
    /// Nodes, leaves included.
    pub nodes: usize,
    /// Memory of nodes and trails, in bytes.
    pub bytes: usize,
    /// Levels below the root.
    pub max_depth: u32,
    /// Mean number of levels above a light; 0 if there is none.
    pub mean_depth: f32,
}

impl ReferenceLightBvhRef<'_> {
    /// How large and how deep the tree is; looks at every trail once.
    #[must_use]
    pub fn stats(&self) -> ReferenceStats {
        let depths = self.trails.iter().filter_map(|trail| trail.depth());
        let (mut lights, mut max_depth, mut sum) = (0, 0, 0);
        for depth in depths {
            lights += 1;
            max_depth = depth.max(max_depth);
            sum += depth as usize;
        }
        ReferenceStats {
            lights,
            nodes: self.nodes.len(),
            bytes: size_of_val(self.nodes) + size_of_val(self.trails),
            max_depth,
            mean_depth: sum as f32 / lights.max(1) as f32,
        }
    }
}
