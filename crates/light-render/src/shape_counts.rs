use core::ops::AddAssign;

use lights::sources::shape::AnyShape;

/// How many area lights have which shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShapeCounts([usize; NAMES.len()]);

/// The shapes in the order of their counts.
const NAMES: [&str; 7] = [
    "triangle",
    "rectangle",
    "bilinear patch",
    "sphere",
    "disk",
    "cylinder",
    "other",
];

impl ShapeCounts {
    /// Of one light.
    pub(crate) fn of(shape: &AnyShape) -> Self {
        let place = match shape {
            AnyShape::Triangle(_) => 0,
            AnyShape::Rectangle(_) => 1,
            AnyShape::BilinearPatch(_) => 2,
            AnyShape::Sphere(_) => 3,
            AnyShape::Disk(_) => 4,
            AnyShape::Cylinder(_) => 5,
            // The shapes are not exhaustive for other crates; those of today are all above.
            _ => 6,
        };
        let mut counts = Self::default();
        counts.0[place] = 1;
        counts
    }

    /// The name of each shape that occurs, and how many there are.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, usize)> + '_ {
        let all = NAMES.into_iter().zip(self.0);
        all.filter(|&(_, count)| count > 0)
    }
}

impl AddAssign for ShapeCounts {
    fn add_assign(&mut self, other: Self) {
        for (count, more) in self.0.iter_mut().zip(other.0) {
            *count += more;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::glam::{Affine3A, Vec3};
    use lights::sources::shape::ShapeDesc;

    #[test]
    fn each_shape_has_a_count_of_its_own() {
        let transform = Affine3A::IDENTITY;
        let (radius, inner_radius) = (1.0, 0.0);
        let length = 1.0;
        let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 1.0), Vec3::Y];
        let shapes = [
            ShapeDesc::Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]),
            ShapeDesc::Rectangle {
                corner: Vec3::ZERO,
                edges: [Vec3::X, Vec3::Y],
            },
            ShapeDesc::Quad(corners),
            ShapeDesc::Sphere { transform, radius },
            ShapeDesc::Disk {
                transform,
                radius,
                inner_radius,
            },
            ShapeDesc::Cylinder {
                transform,
                radius,
                length,
            },
        ];
        let mut all = ShapeCounts::default();
        for (shape, name) in shapes.into_iter().zip(NAMES) {
            let count = ShapeCounts::of(&shape.build().expect("a shape"));
            assert_eq!(count.iter().collect::<Vec<_>>(), [(name, 1)], "{name}");
            all += count;
            all += count;
        }
        let twice: Vec<_> = NAMES[..6].iter().map(|&name| (name, 2)).collect();
        assert_eq!(all.iter().collect::<Vec<_>>(), twice, "in their order");
    }
}
