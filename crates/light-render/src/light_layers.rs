use alloc::borrow::Cow;
use core::error::Error;
use core::fmt;
use core::str::FromStr;
use std::collections::HashMap;

use lights::bounds::LightId;

use crate::World;
use crate::source_ids::source_ids;

/// A group of lights by name: `NAME=PATTERN`. The pattern is the name of a material, an object or a
/// light, in which `*` matches any text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LightGroupPattern {
    /// The group's name.
    pub name: String,
    /// The pattern of its lights' names.
    pub pattern: String,
}

/// Which layer of a picture holds the light of which lights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LightLayers {
    names: Vec<String>,
    /// Lights of adjacent ids in the same layer, in the order of ids.
    runs: Vec<Run>,
}

/// Lights of one layer: those behind the ones before, up to an id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Run {
    end: u32,
    layer: u8,
}

/// Why lights cannot be divided into layers.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightLayersError {
    /// No light has such a name.
    NoLight {
        /// The requested group.
        group: LightGroupPattern,
        /// Some of the names that there are.
        names: Vec<String>,
    },
    /// More groups than layers.
    TooMany {
        /// How many there are.
        groups: usize,
    },
}

impl LightLayers {
    /// The most layers: groups, and the rest.
    pub const MOST: usize = 32;

    /// The name of the layer of lights in no group, and of emission of media.
    pub const REST: &str = "rest";

    /// One layer for each group, and one more for the rest if there is any. A light of several
    /// groups is in the layer of the first. Without groups each material is one, each named light,
    /// and each kind of the others.
    ///
    /// # Errors
    /// When a group has no light, or there are more than 31.
    pub fn new(world: &World, groups: &[LightGroupPattern]) -> Result<Self, LightLayersError> {
        let (ends, names_of): (Vec<u32>, Vec<[Cow<'_, str>; 2]>) = source_ids(world.lights())
            .filter(|(_, ids)| !ids.is_empty())
            .map(|(_, ids)| {
                let names = world.light_names(LightId(ids.start));
                (ids.end, names.unwrap_or_default())
            })
            .unzip();
        let found = if groups.is_empty() {
            by_first_name(&names_of)
        } else {
            by_pattern(&names_of, groups)?
        };
        let (mut names, of_source) = found;
        if names.len() >= Self::MOST {
            let groups = names.len();
            return Err(LightLayersError::TooMany { groups });
        }
        let rest = names.len();
        if world.has_media() || of_source.contains(&None) || names.is_empty() {
            names.push(Self::REST.into());
        }
        let layer = |group: Option<usize>| u8::try_from(group.unwrap_or(rest)).unwrap_or(0);
        let mut runs: Vec<Run> = Vec::new();
        for (end, layer) in ends.into_iter().zip(of_source.into_iter().map(layer)) {
            match runs.last_mut() {
                Some(run) if run.layer == layer => run.end = end,
                _ => runs.push(Run { end, layer }),
            }
        }
        Ok(Self { names, runs })
    }

    /// The names of the layers.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The layer of a light; `None` is the emission of media, which is in the last layer.
    #[inline]
    pub(crate) fn of(&self, light: Option<LightId>) -> usize {
        let run = light.and_then(|LightId(light)| {
            let at = self.runs.partition_point(|run| run.end <= light);
            self.runs.get(at)
        });
        run.map_or(self.names.len() - 1, |run| run.layer.into())
    }
}

/// Names of groups, and the group of each source.
type Groups = (Vec<String>, Vec<Option<usize>>);

/// A group for each first name.
fn by_first_name(names_of: &[[Cow<'_, str>; 2]]) -> Groups {
    let mut names: Vec<String> = Vec::new();
    let mut places = HashMap::new();
    let of_source = names_of.iter().map(|[first, _]| {
        let place = places.entry(first.as_ref()).or_insert_with(|| {
            names.push(first.to_string());
            names.len() - 1
        });
        Some(*place)
    });
    let of_source = of_source.collect();
    (names, of_source)
}

/// The groups of these patterns.
fn by_pattern(
    names_of: &[[Cow<'_, str>; 2]],
    groups: &[LightGroupPattern],
) -> Result<Groups, LightLayersError> {
    let mut names: Vec<String> = Vec::new();
    let mut of_source = vec![None; names_of.len()];
    for group in groups {
        // Several patterns may make one group.
        let place = names.iter().position(|name| *name == group.name);
        let place = place.unwrap_or_else(|| {
            names.push(group.name.clone());
            names.len() - 1
        });
        let mut is_empty = true;
        for (layer, names) in of_source.iter_mut().zip(names_of) {
            if names.iter().any(|name| matches(&group.pattern, name)) {
                layer.get_or_insert(place);
                is_empty = false;
            }
        }
        if is_empty {
            let (mut names, _) = by_first_name(names_of);
            names.truncate(MOST_NAMES);
            let group = group.clone();
            return Err(LightLayersError::NoLight { group, names });
        }
    }
    Ok((names, of_source))
}

/// How many names an error lists.
const MOST_NAMES: usize = 8;

/// Whether `name` matches `pattern`, in which `*` matches any text.
fn matches(pattern: &str, name: &str) -> bool {
    let mut parts = pattern.split('*');
    let start = parts.next().unwrap_or_default();
    let Some(end) = parts.next_back() else {
        return pattern == name;
    };
    let between = name.strip_prefix(start).and_then(|n| n.strip_suffix(end));
    let after = |rest: &'_ str, part: &str| rest.find(part).map(|at| at + part.len());
    let mut rest = match between {
        Some(rest) => rest,
        None => return false,
    };
    for part in parts {
        match after(rest, part) {
            Some(at) => rest = &rest[at..],
            None => return false,
        }
    }
    true
}

impl FromStr for LightGroupPattern {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((name, pattern)) if !name.is_empty() && !pattern.is_empty() => Ok(Self {
                name: name.into(),
                pattern: pattern.into(),
            }),
            _ => Err("expected NAME=PATTERN".into()),
        }
    }
}

impl fmt::Display for LightLayersError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLight { group, names } => {
                let LightGroupPattern { name, pattern } = group;
                let names = names.join(", ");
                write!(
                    f,
                    "group {name}: expected the name of a material, an object or a light, found \
                     {pattern}; lights are called {names}"
                )
            }
            Self::TooMany { groups } => write!(
                f,
                "expected at most {} groups, found {groups}; --group NAME=PATTERN names them",
                LightLayers::MOST - 1
            ),
        }
    }
}

impl Error for LightLayersError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stars_stand_for_any_text() {
        for (pattern, name) in [
            ("lamp", "lamp"),
            ("*", ""),
            ("lamp*", "lamp.001"),
            ("*.001", "lamp.001"),
            ("l*p*1", "lamp.001"),
            ("*ä*", "bläu"),
        ] {
            assert!(matches(pattern, name), "{pattern} is {name}");
        }
        for (pattern, name) in [
            ("lamp", "lamp2"),
            ("lamp*", "a lamp"),
            ("*x*", "lamp"),
            ("", "a"),
        ] {
            assert!(!matches(pattern, name), "{pattern} is not {name}");
        }
    }

    #[test]
    fn patterns_have_two_parts() {
        let pattern: LightGroupPattern = "key=a=*".parse().expect("both");
        assert_eq!((&*pattern.name, &*pattern.pattern), ("key", "a=*"), "both");
        for bad in ["", "key", "key=", "=lamp"] {
            assert!(bad.parse::<LightGroupPattern>().is_err(), "{bad}");
        }
    }
}
