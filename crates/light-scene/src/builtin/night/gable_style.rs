/// How a front ends at the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Gable {
    Stepped,
    Necked,
    Pointed,
    Cornice,
}

impl Gable {
    pub(super) const ALL: [Self; 4] = [Self::Stepped, Self::Necked, Self::Pointed, Self::Cornice];
}
