//! Why tests need not reach some lines.

/// The reason for a line, if it has one: by its file, its text and the line that starts its
/// function.
pub(super) fn reason(file: &str, line: &str, function: &str) -> Option<&'static str> {
    let (line, function) = (line.trim(), function.trim());
    let is_text = line.starts_with("Self::") && line.contains("=> \"");
    let is_of_error = function.contains("fn fmt(") || function.contains("fn source(");
    let of_self = function.contains("self");
    if is_text || is_of_error {
        return Some("the text of an error, or its source");
    }
    if function.contains("const fn ") && !of_self {
        return Some("computed by the compiler, in constants and in examples");
    }
    if function.contains("const fn ") {
        return Some("returns a field");
    }
    if file == "light-bvh/src/simd.rs" {
        return Some("vectors of another width than this machine has");
    }
    if line.contains("::TooMany") || line.contains("(TOO_MANY)") {
        return Some("more lights than 32 bits can count");
    }
    let mut known = KNOWN.iter();
    let is_it = |known: &&Known| known.file == file && line.starts_with(known.line);
    known.find(is_it).map(|known| known.reason)
}

/// One line, by how it starts.
struct Known {
    file: &'static str,
    line: &'static str,
    reason: &'static str,
}

/// Why queries have an answer for places that no tree leads to.
const CHECKED_LINKS: &str =
    "links are checked when a tree is made; without them, this ends a query";

/// Why some lines run on no machine that counts coverage.
const SMALL_MACHINES: &str =
    "machines without vectors or an operating system; `cargo xtask embedded` runs it";

const KNOWN: [Known; 21] = [
    Known {
        file: "light-bvh/src/cut/grow.rs",
        line: "break;",
        reason: CHECKED_LINKS,
    },
    Known {
        file: "light-bvh/src/query/ascent.rs",
        line: "return 0.0;",
        reason: CHECKED_LINKS,
    },
    Known {
        file: "light-bvh/src/query/descent.rs",
        line: "None",
        reason: CHECKED_LINKS,
    },
    Known {
        file: "light-bvh/src/reference/pmf.rs",
        line: "break;",
        reason: CHECKED_LINKS,
    },
    Known {
        file: "light-bvh/src/visibility/fill/mean_importance.rs",
        line: "return;",
        reason: CHECKED_LINKS,
    },
    Known {
        file: "light-bvh/src/visibility/walk.rs",
        line: "return 0.0;",
        reason: CHECKED_LINKS,
    },
    Known {
        file: "light-bvh/src/visibility/walk.rs",
        line: "None => Weights::NONE",
        reason: "a cell that copies nodes is of a tree that has some",
    },
    Known {
        file: "light-bvh/src/query/into_receiver.rs",
        line: "query.run(&AnyKind(self))",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/importance/context_receiver.rs",
        line: "fn reach(&self)",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/importance/context_receiver.rs",
        line: "with_kind!(self.0, receiver => receiver.reach())",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/query/select.rs",
        line: "0",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/query/select.rs",
        line: "for k in 1..WIDTH {",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/query/select.rs",
        line: "ends[k] += ends[k - 1];",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/query/select.rs",
        line: "return ends;",
        reason: SMALL_MACHINES,
    },
    Known {
        file: "light-bvh/src/build/node_children.rs",
        line: "break;",
        reason: "a child with a gain is there",
    },
    Known {
        file: "light-bvh/src/reference/builder.rs",
        line: "None => return LightBounds::EMPTY",
        reason: "there is a node for each light and between two of them",
    },
    Known {
        file: "light-sources/src/lat_long_sky.rs",
        line: "return;",
        reason: "a row has as many weights as texels",
    },
    Known {
        file: "light-sources/src/texture_integral.rs",
        line: "return;",
        reason: "who has places of an image behind has the image",
    },
    Known {
        file: "light-sources/src/light_set.rs",
        line: "LightKind::Triangle => LightRef::Triangle(",
        reason: "triangles are found before the other kinds",
    },
    Known {
        file: "light-sources/src/median_cut/mod.rs",
        line: "fn eq(",
        reason: "an order needs it; a heap calls the order alone",
    },
    Known {
        file: "light-sources/src/median_cut/mod.rs",
        line: "self.cmp(other).is_eq()",
        reason: "an order needs it; a heap calls the order alone",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_cannot_be_reached_or_says_nothing_is_explained() {
        let reason = |line, function| reason("light-math/src/a.rs", line, function).is_some();
        assert!(reason("Self::A => \"a\",", "fn fmt(&self)"), "a text");
        assert!(reason("let x = 1;", "const fn table() -> f32 {"), "a table");
        assert!(!reason("let x = 1;", "pub fn table() -> f32 {"), "code");
        assert!(!reason("return None;", "fn sample(&self) {"), "a branch");
        assert!(
            reason("return Err(Error::TooManyLights);", "fn new("),
            "ids"
        );
    }
}
