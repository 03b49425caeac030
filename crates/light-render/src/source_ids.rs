use core::ops::Range;

use lights::bounds::LightId;
use lights::sources::{LightSet, Rgb, SourceId};

/// The sources of a set, each with the ids of its lights.
pub(crate) fn source_ids(
    lights: &LightSet<Rgb>,
) -> impl Iterator<Item = (SourceId, Range<u32>)> + '_ {
    let count = u32::try_from(lights.len()).unwrap_or(u32::MAX);
    (0..).map(SourceId).map_while(move |source| {
        let LightId(first) = lights.first_id(source)?;
        let next = lights.first_id(SourceId(source.0 + 1));
        Some((source, first..next.map_or(count, |next| next.0)))
    })
}
