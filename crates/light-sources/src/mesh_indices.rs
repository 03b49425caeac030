use alloc::sync::Arc;
use alloc::vec::Vec;

/// The vertex indices of the triangles of a mesh, which may be shared.
///
/// A list takes 12 bytes per triangle, and adds a second dependent memory access to a lookup.
/// Meshes whose triangles hardly share vertices need none; with a million triangles, that access
/// dominates the cost of a light sample.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum MeshIndices {
    /// Triangle `k` has the vertices `3 k`, `3 k + 1` and `3 k + 2`, for `k` below this number.
    Consecutive(u32),
    /// Three vertices per triangle.
    List(Arc<[[u32; 3]]>),
}

impl MeshIndices {
    /// The number of triangles.
    #[inline]
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Consecutive(count) => *count as usize,
            Self::List(list) => list.len(),
        }
    }

    /// Whether there is no triangle at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertices of triangle `k`; `None` beyond the last, and where their numbers are 2^32 or
    /// more.
    #[inline]
    #[must_use]
    pub fn get(&self, k: usize) -> Option<[u32; 3]> {
        match self {
            Self::Consecutive(count) => {
                let k = u32::try_from(k).ok().filter(|k| k < count)?;
                let last = k.checked_mul(3)?.checked_add(2)?;
                Some([last - 2, last - 1, last])
            }
            Self::List(list) => list.get(k).copied(),
        }
    }

    /// The vertices of all triangles.
    pub fn iter(&self) -> impl Iterator<Item = [u32; 3]> + Clone {
        (0..self.len()).map_while(|k| self.get(k))
    }
}

impl<const N: usize> From<[[u32; 3]; N]> for MeshIndices {
    fn from(list: [[u32; 3]; N]) -> Self {
        Self::List(list.into())
    }
}

impl From<Vec<[u32; 3]>> for MeshIndices {
    fn from(list: Vec<[u32; 3]>) -> Self {
        Self::List(list.into())
    }
}

impl From<Arc<[[u32; 3]]>> for MeshIndices {
    fn from(list: Arc<[[u32; 3]]>) -> Self {
        Self::List(list)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn consecutive_triangles_are_those_of_the_list_that_says_so() {
        let list = MeshIndices::from([[0, 1, 2], [3, 4, 5]]);
        let consecutive = MeshIndices::Consecutive(2);
        assert!(consecutive.iter().eq(list.iter()), "the same");
        for indices in [list, consecutive] {
            assert_eq!(indices.len(), 2, "two");
            assert_eq!(indices.get(1), Some([3, 4, 5]), "the second");
            assert_eq!(indices.get(2), None, "no third");
        }
        let many = MeshIndices::Consecutive(u32::MAX);
        assert_eq!(many.get(1 << 31), None, "no number for its vertices");
    }
}
