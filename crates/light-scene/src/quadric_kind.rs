/// A shape of radius 1 around the axis z.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub enum QuadricKind {
    /// The unit sphere around the origin.
    Sphere,
    /// The unit disk in the plane z = 0; its outside is the side of +z.
    Disk {
        /// The radius of the hole in it, in `[0, 1)`; 0 for none.
        inner_radius: f32,
    },
    /// The wall of a tube without its ends, half of it on each side of the origin.
    Cylinder {
        /// Its length.
        length: f32,
    },
}
