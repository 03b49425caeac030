/// How many rays a cell is filled by, and what is made of them.
///
/// Any numbers are valid. The defaults are those of the measurements: about 5,100 rays a coarse
/// cell that is not plain, and 96 a fine one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FillOptions {
    /// Rays of a coarse cell that tell whether it is plain.
    pub first_rays: u32,
    /// Rays of a coarse cell to lights that the tree chooses, the first ones among them: they find
    /// rare light.
    pub exploring_rays: u32,
    /// Rays of each of two further rounds, to lights that the factors learnt so far choose.
    pub guided_rays: u32,
    /// Rays of a fine cell, to where the coarse cell does not know.
    pub fine_rays: u32,
    /// A coarse cell is plain if this share of its first rays is not blocked.
    pub plain_share: f32,
    /// What a child whose lights are never seen keeps of its probability, about: it bounds what
    /// light costs that no ray has found.
    pub floor: f32,
    /// A coarse cell is plain unless its factors make the second moment of one choice this many
    /// times less, as its last rays tell; 0 to ask nothing. Coarse cells do not know what their
    /// fine cells will find: numbers above 1 give up what these would gain.
    pub least_gain: f32,
}

impl Default for FillOptions {
    fn default() -> Self {
        Self {
            first_rays: 48,
            exploring_rays: 4096,
            guided_rays: 512,
            fine_rays: 96,
            plain_share: 0.97,
            floor: 0.1,
            least_gain: 0.0,
        }
    }
}
