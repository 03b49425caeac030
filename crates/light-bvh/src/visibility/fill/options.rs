/// How many rays fill a cell, and how their results are used.
///
/// Any numbers are valid. The defaults are the most that the measurements used: 22,000 rays a coarse
/// cell that is not plain, and 192 a fine one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FillOptions {
    /// Rays that decide whether a coarse cell is plain.
    pub first_rays: u32,
    /// Rays of a coarse cell to lights that the tree chooses, including the first ones: they find
    /// light that few rays see.
    pub exploring_rays: u32,
    /// Rays of each of two further rounds, to lights that the factors learnt so far choose.
    pub guided_rays: u32,
    /// Rays of a fine cell, to lights whose visibility the coarse cell leaves open: so many where it
    /// leaves that of all lights open, fewer where it knows most of them.
    pub fine_rays: u32,
    /// A coarse cell is plain if this share of its first rays is not blocked.
    pub plain_share: f32,
    /// About the share of its probability that a child keeps if no ray sees its lights: it bounds
    /// the noise of light that no ray has found.
    pub floor: f32,
    /// A coarse cell is plain unless its factors divide the second moment of one choice by at least
    /// this number, as estimated from its last rays; with 0 there is no such test. The estimate
    /// leaves out the gain of fine cells: a number above 1 also drops cells whose fine cells would
    /// gain.
    pub least_gain: f32,
}

impl Default for FillOptions {
    fn default() -> Self {
        Self {
            first_rays: 48,
            exploring_rays: 20_000,
            guided_rays: 1024,
            fine_rays: 192,
            plain_share: 0.97,
            floor: 0.1,
            least_gain: 0.0,
        }
    }
}
