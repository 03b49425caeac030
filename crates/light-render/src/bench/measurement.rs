use crate::SamplerKind;

/// What is measured of samplers, on whichever lights.
#[derive(Clone, Debug)]
pub struct Measurement {
    /// The samplers, in the order of the rows.
    pub samplers: Vec<SamplerKind>,
    /// Samples of one call.
    pub k: u32,
    /// How many receivers the variance is taken over; `None` for as many as the options of the
    /// bench say.
    pub var_points: Option<usize>,
    /// Whether builds, queries and refits are timed; otherwise these times are 0, or `None`.
    pub is_timed: bool,
    /// Threads that build a tree and sum the variance. Queries are timed on one.
    pub threads: usize,
}

impl Default for Measurement {
    /// One sample a call, one thread, the samplers whose time does not grow with the lights.
    fn default() -> Self {
        Self {
            samplers: SamplerKind::SUBLINEAR.to_vec(),
            k: 1,
            var_points: None,
            is_timed: true,
            threads: 1,
        }
    }
}
