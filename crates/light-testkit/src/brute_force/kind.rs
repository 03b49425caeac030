/// A kind of light that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One triangle.
    Triangle,
    /// A rectangle.
    Rectangle,
    /// A flat or twisted quadrilateral.
    Quad,
    /// A sphere.
    Sphere,
    /// A disk or an annulus.
    Disk,
    /// An open cylinder.
    Cylinder,
    /// A triangle of a mesh.
    Mesh,
    /// A triangle of a mesh that is placed by an affine transform.
    PlacedMesh,
    /// A point light.
    Point,
    /// A spot light.
    Spot,
    /// A projector.
    Projection,
    /// A goniometric light.
    Goniometric,
    /// A distant light.
    Distant,
    /// A sun.
    Sun,
    /// A uniform sky.
    UniformInfinite,
    /// A sky by an image, in either map.
    ImageInfinite,
    /// A sky behind a portal.
    PortalInfinite,
    /// A sky that is cut into distant lights.
    MedianCut,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 18] = [
        Self::Triangle,
        Self::Rectangle,
        Self::Quad,
        Self::Sphere,
        Self::Disk,
        Self::Cylinder,
        Self::Mesh,
        Self::PlacedMesh,
        Self::Point,
        Self::Spot,
        Self::Projection,
        Self::Goniometric,
        Self::Distant,
        Self::Sun,
        Self::UniformInfinite,
        Self::ImageInfinite,
        Self::PortalInfinite,
        Self::MedianCut,
    ];
}
