use lights::bounds::SampledLight;

/// The lights chosen at a vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct ChosenLights {
    /// The usual number of choices, stored inline.
    first: [Option<SampledLight>; 2],
    more: Vec<SampledLight>,
}

impl ChosenLights {
    /// Appends a choice.
    #[inline]
    pub(super) fn push(&mut self, choice: SampledLight) {
        match self.first.iter_mut().find(|place| place.is_none()) {
            Some(place) => *place = Some(choice),
            None => self.more.push(choice),
        }
    }

    /// All of them, in the order of choice.
    #[inline]
    pub(super) fn iter(&self) -> impl Iterator<Item = SampledLight> {
        self.first.iter().flatten().chain(&self.more).copied()
    }
}
