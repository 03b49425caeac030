use core::error::Error;
use core::fmt;

/// Why a triangle is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TriangleError {
    /// A vertex is not finite.
    Vertex,
    /// The vertices lie on a line, or so close that one over the area is no finite number.
    Area,
}

impl fmt::Display for TriangleError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vertex => "vertices: must be finite",
            Self::Area => "vertices: must span an area above 0",
        })
    }
}

impl Error for TriangleError {}
