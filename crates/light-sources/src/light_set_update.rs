use alloc::vec::Vec;
use core::error::Error;
use core::fmt;

use crate::color::ColorModel;
use crate::light::Light;
use crate::light_desc::{LightDesc, LightDescError};
use crate::light_kinds::{LightKind, LightSource};
use crate::light_set::LightSet;
use crate::source_table::{SourceId, SourcePlace};
use light_bounds::LightExtent;

/// Why a source of a [`LightSet`] is not changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightUpdateError {
    /// The set has no such source.
    UnknownSource,
    /// The new description is invalid.
    Description(LightDescError),
    /// The new description is of another kind of light; of own lights, of another
    /// [`LightType`](crate::LightType). Or the source is a placed mesh, which
    /// [`LightSet::update_placement`] moves.
    OtherKind,
    /// The new description has another number of triangles, so that the ids behind it would move.
    OtherCount {
        /// The number of lights of the source.
        expected: usize,
        /// The number of lights of the new description.
        given: usize,
    },
}

impl<C: ColorModel> LightSet<C> {
    /// Replaces one source by another of the same kind and number of lights: a light that moves,
    /// turns, or changes what it emits. No id changes, and no other source is touched.
    ///
    /// Lights come and go as others are switched on and off: sources that are off are the room for
    /// those to come. The example [`moving_lights`][1] moves a lamp, and adds and removes
    /// others.
    ///
    /// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/moving_lights.rs
    ///
    /// Costs what the construction of the one source costs. A sky with the
    /// [`map`](crate::EnvironmentMap) that it had, lat-long or equal-area, keeps its tables, so
    /// that it turns or dims at no cost: give a clone of the same image, which shares its texels.
    /// Light samplers learn of the change by [`extents_into`](Self::extents_into) and their
    /// `refit`.
    ///
    /// # Errors
    /// When the source is unknown, or the description invalid, of another kind, or of another
    /// number of lights; the set is unchanged then.
    pub fn update(
        &mut self,
        source: SourceId,
        desc: impl Into<LightDesc<C>>,
    ) -> Result<(), LightUpdateError> {
        let unknown = LightUpdateError::UnknownSource;
        let (kind, index) = match self.sources.place(source).ok_or(unknown)? {
            SourcePlace::Listed { kind, index } => (kind, index),
            SourcePlace::Placed(_) => return Err(LightUpdateError::OtherKind),
        };
        let expected = self.sources.ids(source).ok_or(unknown)?.len();
        let index = index as usize;
        let new = match (kind, desc.into()) {
            (LightKind::ImageInfinite, LightDesc::ImageInfinite(desc)) => {
                let light = self.lists.image_infinites[index].updated(desc);
                LightSource::ImageInfinite(light.map_err(LightDescError::ImageInfinite)?)
            }
            (_, desc) => LightSource::new(desc, self.scene)?,
        };
        let is_other = match &new {
            LightSource::Own(light) if kind == LightKind::Own => {
                light.light_type() != self.lists.owns[index].light_type()
            }
            _ => new.kind() != kind,
        };
        if is_other {
            return Err(LightUpdateError::OtherKind);
        }
        let given = new.lights();
        if given != expected {
            return Err(LightUpdateError::OtherCount { expected, given });
        }
        self.lists.replace(index, new);
        Ok(())
    }

    /// The [`extents`](Self::extents) of all lights, by id, in place of what `extents` held;
    /// allocates nothing where its capacity suffices.
    pub fn extents_into(&self, extents: &mut Vec<LightExtent>) {
        extents.clear();
        extents.extend(self.iter().map(|(_, light)| light.extent()));
    }
}

impl fmt::Display for LightUpdateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownSource => f.write_str("the set has no such source"),
            Self::Description(error) => error.fmt(f),
            Self::OtherKind => f.write_str("a source cannot become another kind of light"),
            Self::OtherCount { expected, given } => {
                write!(
                    f,
                    "a source of {expected} lights cannot become one of {given}"
                )
            }
        }
    }
}

impl Error for LightUpdateError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            Self::Description(error) => Some(error),
            _ => None,
        }
    }
}

impl From<LightDescError> for LightUpdateError {
    fn from(error: LightDescError) -> Self {
        Self::Description(error)
    }
}

#[cfg(test)]
mod tests;
