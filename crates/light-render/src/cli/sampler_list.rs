use core::str::FromStr;

use crate::SamplerKind;

use super::failure::Failure;

/// The samplers of `--samplers`, names with commas between.
///
/// # Errors
/// A name that no sampler has.
pub(super) fn samplers(list: &str) -> Result<Vec<SamplerKind>, Failure> {
    list.split(',')
        .map(SamplerKind::from_str)
        .collect::<Result<_, _>>()
        .map_err(|error| Failure::Input(format!("--samplers: {error}")))
}

/// The names of `kinds` as `--samplers` takes them.
pub(super) fn list(kinds: &[SamplerKind]) -> String {
    let names: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
    names.join(",")
}
