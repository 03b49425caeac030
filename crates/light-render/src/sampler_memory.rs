use lights::bounds::LightExtent;

use crate::{AnyLightSamplerError, SamplerKind, available_memory};

/// What needs less is not checked: asking the system takes longer than a small tree.
const SMALL: u64 = 1 << 28;

/// Bytes a light while the lists that a sampler is built from and the sampler itself are made, with
/// a tenth of room: measured with 10^7 lights.
const fn bytes_a_light(kind: SamplerKind) -> u64 {
    match kind {
        SamplerKind::Uniform => 0,
        SamplerKind::Power => 40,
        SamplerKind::Exhaustive => 200,
        SamplerKind::BvhReference => 300,
        SamplerKind::Bvh | SamplerKind::BvhMorton => 220,
    }
}

/// Makes sure that there is memory for a sampler of `kind` over so many lights, and for their
/// extents.
///
/// # Errors
/// [`AnyLightSamplerError::Memory`] when there is less.
pub(crate) fn check_memory(kind: SamplerKind, lights: usize) -> Result<(), AnyLightSamplerError> {
    check(kind, lights, 0)
}

/// Makes sure that there is memory for a sampler of `kind` beside the extents of its lights.
///
/// # Errors
/// [`AnyLightSamplerError::Memory`] when there is less.
pub(crate) fn check_memory_beside(
    kind: SamplerKind,
    extents: &[LightExtent],
) -> Result<(), AnyLightSamplerError> {
    check(kind, extents.len(), size_of_val(extents) as u64)
}

fn check(kind: SamplerKind, lights: usize, taken: u64) -> Result<(), AnyLightSamplerError> {
    let needed = bytes_a_light(kind).saturating_mul(lights as u64);
    let needed = needed.saturating_sub(taken);
    if needed < SMALL {
        return Ok(());
    }
    fits(kind, lights, needed, available_memory())
}

fn fits(
    kind: SamplerKind,
    lights: usize,
    needed: u64,
    available: u64,
) -> Result<(), AnyLightSamplerError> {
    if needed <= available {
        return Ok(());
    }
    Err(AnyLightSamplerError::Memory {
        kind,
        lights,
        needed,
        available,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_many_lights_for_the_memory_are_refused() {
        for kind in SamplerKind::ALL {
            assert_eq!(check_memory(kind, 1000), Ok(()), "{kind}: few");
            let many = check_memory(kind, 1 << 50);
            if kind == SamplerKind::Uniform {
                assert_eq!(many, Ok(()), "it stores no light");
            } else {
                let error = many.expect_err("a petabyte").to_string();
                assert!(error.contains(kind.name()), "{error}");
                assert!(error.contains("1125899906842624 lights"), "{error}");
            }
        }
        let refused = fits(SamplerKind::Bvh, 7, 43_200_000_000, 1 << 33).expect_err("too many");
        assert_eq!(
            refused.to_string(),
            "bvh over 7 lights: needs 43.2 GB of memory, 8.6 GB are available",
            "one line"
        );
    }
}
