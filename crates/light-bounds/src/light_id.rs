/// Identifies a light of a set by its position.
///
/// A set of `n` lights has the ids `0..n`. An emissive mesh is one source whose triangles have
/// consecutive ids, so that the id of a hit (mesh, triangle) is the sum of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "bytemuck", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(transparent)]
pub struct LightId(pub u32);

impl LightId {
    /// The id as an index into arrays that hold one entry a light.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_a_position() {
        assert_eq!(LightId(7).index(), 7, "the number itself");
    }
}
