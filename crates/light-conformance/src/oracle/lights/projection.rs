use super::at_point::{AtPoint, Directional};
use super::fields::number;
use super::picture::Picture;
use crate::oracle::Jitter;
use crate::oracle::table::ExactTable;
use crate::{Case, Malformed};
use glam::{DVec2, DVec3};

/// A picture on the plane z = 1, seen from the light.
pub(super) struct Projection {
    scale: f64,
    picture: Picture,
    /// Half the picture on the plane.
    half: DVec2,
    /// By which directions are chosen: brightness times solid angle per area at texel centres.
    table: ExactTable,
}

pub(super) fn projection(case: &Case<'_>) -> Result<AtPoint<Projection>, Malformed> {
    let picture = Picture::read(case)?;
    let size = DVec2::new(picture.nx as f64, picture.ny as f64);
    let half = (0.5 * number(case, "fov_deg")?.to_radians()).tan() * size / size.min_element();
    let mut table = picture.averages();
    for (i, weight) in table.weights.iter_mut().enumerate() {
        let place = DVec2::new((i % picture.nx) as f64, (i / picture.nx) as f64);
        *weight *= solid_angle_per_area((2.0 * (place + 0.5) / size - 1.0) * half);
    }
    let emission = Projection {
        scale: number(case, "scale")?,
        picture,
        half,
        table,
    };
    AtPoint::new(case, emission)
}

fn solid_angle_per_area(p: DVec2) -> f64 {
    (1.0 + p.length_squared()).powf(-1.5)
}

impl Projection {
    /// The place in the picture.
    fn uv(&self, w: DVec3) -> Option<DVec2> {
        let uv = 0.5 * (w.truncate() / w.z / self.half) + 0.5;
        let is_inside = uv.cmpge(DVec2::ZERO).all() && uv.cmple(DVec2::ONE).all();
        (w.z > 0.0 && is_inside).then_some(uv)
    }
}

impl Directional for Projection {
    fn intensity(&self, w: DVec3) -> DVec3 {
        self.uv(w)
            .map_or(DVec3::ZERO, |uv| self.scale * self.picture.nearest(uv))
    }

    /// Each texel times its solid angle.
    fn power(&self) -> DVec3 {
        let (nx, ny) = (self.picture.nx, self.picture.ny);
        // The solid angle of the rectangle between the axis and a point of the plane.
        let up_to = |x: usize, y: usize| {
            let p = DVec2::new(x as f64 / nx as f64, y as f64 / ny as f64);
            let p = (2.0 * p - 1.0) * self.half;
            f64::atan2(p.x * p.y, (1.0 + p.length_squared()).sqrt())
        };
        let mut sum = DVec3::ZERO;
        for (i, texel) in self.picture.texels.iter().enumerate() {
            let (x, y) = (i % nx, i / nx);
            let omega = up_to(x + 1, y + 1) - up_to(x, y + 1) - up_to(x + 1, y) + up_to(x, y);
            sum += *texel * omega;
        }
        self.scale * sum
    }

    fn sample(&self, u1: DVec2, _u2: DVec2, jitter: &mut Jitter) -> Option<DVec3> {
        let uv = self.table.sample(u1, jitter)?;
        Some(((2.0 * uv - 1.0) * self.half).extend(1.0).normalize())
    }

    fn pdf(&self, w: DVec3) -> f64 {
        let area = 4.0 * self.half.element_product();
        self.uv(w).map_or(0.0, |uv| {
            let p = (2.0 * uv - 1.0) * self.half;
            self.table.pdf(uv) / (area * solid_angle_per_area(p))
        })
    }

    fn bounds(&self) -> ([f64; 3], bool) {
        let maxima = self.picture.texels.iter().map(|t| t.max_element());
        let mean = maxima.sum::<f64>() / self.picture.texels.len() as f64;
        let cos_corner = (1.0 + self.half.length_squared()).powf(-0.5);
        ([self.scale * mean, 1.0, cos_corner], true)
    }
}
