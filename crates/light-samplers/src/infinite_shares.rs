use alloc::vec::Vec;

use light_bounds::{LightExtent, LightId, SampledLight};
use light_math::fraction;

use crate::first_choice::{FirstChoice, FirstPmf};

/// The first choice: each light at infinity has one share, all lights with a position share one.
///
/// `p_infinite = n / (n + 1)` for `n` lights at infinity, or `n / n` when there are no others.
/// Lights of zero fluence have no share.
///
/// # Source
/// `[PBRT4]`, section 12.6.3.
#[derive(Clone, Debug)]
pub(crate) struct InfiniteShares {
    /// In ascending order.
    lights: Vec<LightId>,
    /// All shares, one for each infinite light and one for the others if there are any.
    shares: u32,
}

impl InfiniteShares {
    /// The infinite ones of `lights`, fewer than 2^32, and one share for the others if
    /// `has_others`.
    #[expect(
        clippy::cast_possible_truncation,
        reason = "ids are 32 bits, so there are no more lights"
    )]
    pub(crate) fn new(lights: &[LightExtent], has_others: HasOthers) -> Self {
        let ids = (0..).map(LightId).zip(lights);
        let emitting = ids.filter(|(_, extent)| extent.infinite().is_some_and(|i| i.fluence > 0.0));
        let lights: Vec<_> = emitting.map(|(id, _)| id).collect();
        let others = match has_others {
            HasOthers::Yes => 1,
            HasOthers::No => 0,
        };
        Self {
            shares: lights.len() as u32 + others,
            lights,
        }
    }

    /// The first choice; `None` if there is no light at all.
    #[inline]
    pub(crate) fn choose(&self, u: u64) -> Option<FirstChoice> {
        if self.shares == 0 {
            return None;
        }
        let (share, u) = fraction::choose(self.shares, u);
        Some(match self.lights.get(share as usize) {
            Some(&light) => FirstChoice::Infinite(SampledLight {
                light,
                pmf: self.pmf_share(),
                u,
            }),
            None => FirstChoice::Others {
                pmf: self.pmf_share(),
                u,
            },
        })
    }

    /// The probability of each share.
    #[inline]
    fn pmf_share(&self) -> f32 {
        1.0 / self.shares.max(1) as f32
    }

    /// The probability of the first choice that leads to `light`.
    #[inline]
    pub(crate) fn first_pmf(&self, light: LightId) -> FirstPmf {
        let pmf = self.pmf_share();
        match self.lights.binary_search(&light) {
            Ok(_) => FirstPmf::Infinite(pmf),
            Err(_) => FirstPmf::Others(pmf),
        }
    }
}

/// Whether there are lights with a position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HasOthers {
    Yes,
    No,
}
