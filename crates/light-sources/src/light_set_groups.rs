use alloc::vec;
use alloc::vec::Vec;

use crate::color::ColorModel;
use crate::light_set::LightSet;
use crate::light_set_update::LightUpdateError;
use crate::source_table::SourceId;
use light_bounds::LightGroups;

/// Groups of lights, for light linking and for pictures by groups. A source is in all groups until
/// it gets its own.
impl<C: ColorModel> LightSet<C> {
    /// Sets the groups of all lights of a source.
    ///
    /// # Errors
    /// [`LightUpdateError::UnknownSource`]; the set is unchanged then.
    pub fn set_groups(
        &mut self,
        source: SourceId,
        groups: LightGroups,
    ) -> Result<(), LightUpdateError> {
        self.sources
            .set_groups(source, groups)
            .ok_or(LightUpdateError::UnknownSource)
    }

    /// The groups of all lights, by id, for light samplers.
    #[must_use]
    pub fn groups(&self) -> Vec<LightGroups> {
        let mut groups = vec![LightGroups::ALL; self.len()];
        for (ids, of_source) in self.sources.groups() {
            groups[ids.start as usize..ids.end as usize].fill(of_source);
        }
        groups
    }
}
