use core::fmt;

/// The direction of a vertical and a horizontal angle, `v` and `h`.
///
/// # Source
/// `[LM63]`, section 3: photometric zero, the nadir, is (v, h) = (0, 0) in types B and C and (-90,
/// 0) in type A; photometric horizontal is (90, 0) in types B and C and (0, 0) in type A. Seen from
/// above, horizontal angles run clockwise in types A and B, counter-clockwise in type C. `[LM75]`
/// has the axes: the pole of type A is vertical, that of type B is horizontal and across the beam,
/// so that there `v` turns around it and `h` is a latitude. Type B is that of `[Radiance]`,
/// `source.cal`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WebType {
    /// Automotive lights: `(cos v cos h, sin v, cos v sin h)`.
    A,
    /// Floodlights: `(cos h sin v, -cos h cos v, sin h)`.
    B,
    /// Anything else, indoors and along roads: `(sin v cos h, -cos v, -sin v sin h)`.
    C,
}

impl fmt::Display for WebType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
        })
    }
}
