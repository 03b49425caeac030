use crate::UvSet;

/// The texture coordinates that a material uses, by their numbers in the file: those that its mesh
/// gets as first and second ones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct UvSets(pub(super) [Option<usize>; 2]);

impl UvSets {
    /// The place of the set with this number in the file; `None` if two others have the places.
    pub(super) fn place(&mut self, number: usize) -> Option<UvSet> {
        for (place, set) in self.0.iter_mut().zip([UvSet::First, UvSet::Second]) {
            if *place.get_or_insert(number) == number {
                return Some(set);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_sets_find_a_place() {
        let mut sets = UvSets::default();
        assert_eq!(
            sets.place(1),
            Some(UvSet::First),
            "the first that is needed"
        );
        assert_eq!(sets.place(0), Some(UvSet::Second), "another");
        assert_eq!(sets.place(1), Some(UvSet::First), "again");
        assert_eq!(sets.place(2), None, "a third");
    }
}
