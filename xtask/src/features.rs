//! The feature sets that are checked: the one list of them.

use crate::steps::{Outcome, StepResult, side_by_side};

/// What a feature set expects of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// No operating system and no memory allocator.
    Core,
    /// A memory allocator.
    Alloc,
    /// An operating system.
    Std,
}

impl Needs {
    /// All of them.
    const ALL: [Self; 3] = [Self::Core, Self::Alloc, Self::Std];

    /// The name of the folder for what is built with sets of this kind.
    #[must_use]
    pub const fn folder(self) -> &'static str {
        match self {
            Self::Core => "core",
            Self::Alloc => "alloc",
            Self::Std => "std",
        }
    }
}

/// Features of one library crate, its default ones off.
#[derive(Clone, Copy, Debug)]
pub struct FeatureSet {
    /// Name of the package.
    pub package: &'static str,
    /// Features, separated by commas.
    pub features: &'static str,
    /// What the crate then expects.
    pub needs: Needs,
}

impl FeatureSet {
    /// Whether the package is one of those on which no other library depends: their sets compile
    /// every library, with each of its features on and off.
    #[must_use]
    pub fn is_of_a_whole(&self) -> bool {
        WHOLES.contains(&self.package)
    }

    /// The arguments of cargo that choose this set of this package alone.
    #[must_use]
    pub fn arguments(&self) -> [&'static str; 5] {
        [
            "--package",
            self.package,
            "--no-default-features",
            "--features",
            self.features,
        ]
    }
}

/// The libraries with feature sets on which no other one depends.
const WHOLES: [&str; 2] = ["lights", "light-gpu"];

/// Every crate alone, at least without std and with every feature that it has. The default features
/// are checked with the workspace.
pub const FEATURE_SETS: &[FeatureSet] = &[
    core("light-math", "libm"),
    core("light-math", "libm,bytemuck,serde"),
    alloc("light-math", "libm,alloc"),
    std("light-math", "std,libm,bytemuck,serde"),
    core("light-bounds", "libm"),
    core("light-bounds", "libm,bytemuck,serde"),
    std("light-bounds", "std,bytemuck,serde"),
    core("light-bvh", "libm"),
    core("light-bvh", "libm,bytemuck"),
    alloc("light-bvh", "libm,alloc,bytemuck"),
    std("light-bvh", "std,rayon"),
    core("light-samplers", "libm"),
    alloc("light-samplers", "libm,alloc"),
    std("light-samplers", "std,rayon"),
    core("light-sources", "libm"),
    alloc("light-sources", "libm,alloc"),
    std("light-sources", "std,rayon,half"),
    alloc("light-sources", "libm,serde"),
    alloc("light-sources", "libm,half,serde"),
    core("light-media", "libm"),
    alloc("light-media", "libm,alloc"),
    std("light-media", "std"),
    alloc("light-media", "libm,serde"),
    core("light-photometry", "libm"),
    alloc("light-photometry", "libm,alloc"),
    std("light-photometry", "std"),
    alloc("light-gpu", "libm"),
    std("light-gpu", "std"),
    core("lights", "libm"),
    alloc("lights", "libm,alloc,bytemuck"),
    core("lights", "libm,bytemuck"),
    alloc("lights", "libm,alloc,half,serde"),
    std("lights", "std,half,rayon,bytemuck,serde"),
];

/// Runs `check` for the sets that `select` chooses, all of them, whatever fails.
///
/// Sets of different [needs](Needs) run side by side: a set is a chain of crates, which cargo
/// compiles one after the other. So `check` must build in a target folder for each of them.
///
/// # Errors
/// What failed, one line a set.
pub fn for_each_set(
    select: impl Fn(&FeatureSet) -> bool + Sync,
    check: impl Fn(&FeatureSet) -> Result<(), String> + Sync,
) -> StepResult {
    let errors_of = |needs| -> Vec<String> {
        let sets = FEATURE_SETS.iter().filter(|set| set.needs == needs);
        sets.filter(|set| select(set))
            .filter_map(|set| {
                let error = check(set).err()?;
                Some(format!("{} with {}: {error}", set.package, set.features))
            })
            .collect()
    };
    let errors = side_by_side(&Needs::ALL, |&needs| errors_of(needs)).concat();
    if errors.is_empty() {
        Ok(Outcome::Passed)
    } else {
        Err(errors.join("\n        "))
    }
}

/// The sets that are tested a second time, without std: float functions in software, the same bits
/// on every machine. They are built and tested together.
pub const SOFTWARE_FLOATS: &[FeatureSet] = &[
    alloc("light-math", "libm,alloc"),
    core("light-bounds", "libm"),
    alloc("light-bvh", "libm,alloc"),
    alloc("light-samplers", "libm,alloc"),
    alloc("light-sources", "libm,alloc"),
    alloc("light-media", "libm,alloc"),
    alloc("light-photometry", "libm,alloc"),
];

/// The arguments of cargo that choose these sets together, each of another package.
#[must_use]
pub fn together(sets: &[FeatureSet]) -> Vec<String> {
    let packages = sets.iter().flat_map(|set| ["--package", set.package]);
    let features = sets.iter().flat_map(|set| {
        let of_package = |feature| format!("{}/{feature}", set.package);
        set.features.split(',').map(of_package)
    });
    let features: Vec<String> = features.collect();
    let mut arguments: Vec<String> = packages.map(str::to_owned).collect();
    arguments.extend(["--no-default-features".into(), "--features".into()]);
    arguments.push(features.join(","));
    arguments
}

const fn core(package: &'static str, features: &'static str) -> FeatureSet {
    FeatureSet {
        package,
        features,
        needs: Needs::Core,
    }
}

const fn alloc(package: &'static str, features: &'static str) -> FeatureSet {
    FeatureSet {
        package,
        features,
        needs: Needs::Alloc,
    }
}

const fn std(package: &'static str, features: &'static str) -> FeatureSet {
    FeatureSet {
        package,
        features,
        needs: Needs::Std,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::root;

    fn manifest(package: &str) -> String {
        let path = root().join("crates").join(package).join("Cargo.toml");
        std::fs::read_to_string(path).expect("a manifest")
    }

    /// The names in the `[features]` table of a package's manifest.
    fn features_of(package: &str) -> Vec<String> {
        let manifest = manifest(package);
        let table = manifest.split("[features]").nth(1).unwrap_or_default();
        let table = table.split("\n[").next().unwrap_or_default();
        let names = table.lines().filter_map(|line| line.split_once(" = "));
        names.map(|(name, _)| name.trim().to_owned()).collect()
    }

    #[test]
    fn sets_are_chosen_together() {
        let sets = [core("a", "libm"), alloc("b", "libm,alloc")];
        let expected = "--package a --package b --no-default-features --features \
                        a/libm,b/libm,b/alloc";
        assert_eq!(together(&sets).join(" "), expected, "one call");
    }

    #[test]
    fn every_library_crate_and_feature_is_in_a_set() {
        for entry in std::fs::read_dir(root().join("crates")).expect("a folder of crates") {
            let name = entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned();
            // Programs and test tools have no features to choose from.
            let others = [
                "light-conformance",
                "light-render",
                "light-scene",
                "light-sets",
                "light-testkit",
            ];
            if others.contains(&name.as_str()) {
                continue;
            }
            let sets: Vec<_> = FEATURE_SETS.iter().filter(|s| s.package == name).collect();
            for feature in features_of(&name) {
                let listed = sets
                    .iter()
                    .any(|s| s.features.split(',').any(|f| f == feature));
                assert!(
                    feature == "default" || listed,
                    "{name}: feature {feature} is in no set"
                );
            }
            assert!(
                sets.iter().any(|s| s.needs != Needs::Std),
                "{name}: no set without std"
            );
        }
    }

    #[test]
    fn every_library_is_below_a_whole() {
        let manifests: Vec<String> = FEATURE_SETS
            .iter()
            .map(|set| manifest(set.package))
            .collect();
        let is_named = |words: &str| manifests.iter().any(|manifest| manifest.contains(words));
        for set in FEATURE_SETS.iter().filter(|set| !set.is_of_a_whole()) {
            let package = set.package;
            let dependency = format!("\n{package} = {{ workspace");
            assert!(is_named(&dependency), "no library depends on {package}");
            for feature in set.features.split(',') {
                let forwarded = is_named(&format!("\"{package}/{feature}\""));
                assert!(
                    forwarded,
                    "no feature of another library is {package}/{feature}"
                );
            }
        }
    }
}
