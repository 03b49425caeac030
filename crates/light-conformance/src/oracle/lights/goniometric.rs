use super::super::equal_area::{sphere_to_square, square_to_sphere};
use super::super::warp::SPHERE_PDF;
use super::at_point::{AtPoint, Directional};
use super::fields::number;
use super::picture::Picture;
use crate::oracle::Jitter;
use crate::oracle::table::ExactTable;
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Intensity by an equal-area picture.
pub(super) struct Goniometric {
    scale: f64,
    table: ExactTable,
}

pub(super) fn goniometric(case: &Case<'_>) -> Result<AtPoint<Goniometric>, Malformed> {
    let emission = Goniometric {
        scale: number(case, "scale")?,
        table: Picture::read(case)?.averages(),
    };
    AtPoint::new(case, emission)
}

impl Directional for Goniometric {
    fn intensity(&self, w: DVec3) -> DVec3 {
        let texel = self.table.texel(sphere_to_square(w));
        DVec3::splat(self.scale * self.table.weights[texel])
    }

    fn power(&self) -> DVec3 {
        DVec3::splat(self.bounds().0[0])
    }

    fn sample(&self, u1: DVec2, _u2: DVec2, jitter: &mut Jitter) -> Option<DVec3> {
        self.table.sample(u1, jitter).map(square_to_sphere)
    }

    fn pdf(&self, w: DVec3) -> f64 {
        self.table.pdf(sphere_to_square(w)) * SPHERE_PDF
    }

    fn bounds(&self) -> ([f64; 3], bool) {
        let phi = 4.0 * PI * self.scale * self.table.mean();
        ([phi, -1.0, 0.0], false)
    }
}
