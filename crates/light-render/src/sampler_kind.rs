use core::fmt;
use core::str::FromStr;

/// A way to choose one light of many, by its name on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SamplerKind {
    /// Every light alike.
    Uniform,
    /// Strong lights more often, wherever they are.
    Power,
    /// Every light by its importance at the point, in time linear in the lights.
    Exhaustive,
    /// The published light hierarchy.
    BvhReference,
    /// The default light hierarchy.
    Bvh,
    /// The default light hierarchy, built in less time.
    BvhMorton,
}

impl SamplerKind {
    /// The default kind of the program.
    pub const DEFAULT: Self = Self::Bvh;

    /// All kinds.
    pub const ALL: [Self; 6] = [
        Self::Uniform,
        Self::Power,
        Self::Exhaustive,
        Self::BvhReference,
        Self::Bvh,
        Self::BvhMorton,
    ];

    /// Those that do not look at every light for each choice.
    pub(crate) const SUBLINEAR: [Self; 4] =
        [Self::Uniform, Self::Power, Self::BvhReference, Self::Bvh];

    /// The kind's name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Power => "power",
            Self::Exhaustive => "exhaustive",
            Self::BvhReference => "bvh-reference",
            Self::Bvh => "bvh",
            Self::BvhMorton => "bvh-morton",
        }
    }
}

impl fmt::Display for SamplerKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for SamplerKind {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("expected one of {names}, found `{name}`")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_found_by_its_name() {
        for kind in SamplerKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind), "{kind}");
        }
        let wrong = "best".parse::<SamplerKind>();
        assert!(
            wrong.is_err_and(|words| words.ends_with("found `best`")),
            "no such sampler"
        );
    }
}
