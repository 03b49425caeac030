use super::super::equal_area::sphere_to_square;
use super::exact_light::{Arriving, ExactBounds, ExactLight, Leaving, RayPdf, Receiver};
use super::fields::{number, point, transform};
use super::infinite::Scene;
use super::picture::Picture;
use crate::oracle::table::ExactTable;
use crate::oracle::{ExactWindows, Jitter};
use crate::{Case, Malformed};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::{FRAC_PI_2, PI};

/// A sky seen through a rectangle (Bitterli et al. 2015): the picture over the angles of x and y to
/// z in the frame of the rectangle.
pub(crate) struct PortalSky {
    scene: Scene,
    corner: DVec3,
    size: DVec2,
    /// The columns are the axes.
    frame: DMat3,
    scale: f64,
    picture: Picture,
    windows: ExactWindows,
}

impl PortalSky {
    pub(crate) fn new(case: &Case<'_>) -> Result<Self, Malformed> {
        let corner = |i| point(&case.get("portal")?.at(i)?);
        let (p0, p1, p3) = (corner(0)?, corner(1)?, corner(3)?);
        let (x, y) = ((p3 - p0).normalize(), (p1 - p0).normalize());
        let z = x.cross(y).normalize();
        let frame = DMat3::from_cols(x, z.cross(x), z);
        let sky = Picture::read(case)?;
        let n = sky.nx;
        let to_light = transform(&case.get("render_from_light")?)?.0.transpose();
        let (mut texels, mut weights) = (Vec::new(), Vec::new());
        for i in 0..n * n {
            let uv = (DVec2::new((i % n) as f64, (i / n) as f64) + 0.5) / n as f64;
            let w = direction(uv);
            let texel = sky.bilinear(sphere_to_square(to_light * (frame * w)));
            texels.push(texel);
            weights.push(texel.element_sum() / 3.0 * solid_angle_per_area(w));
        }
        Ok(Self {
            scene: Scene::read(case)?,
            corner: p0,
            size: DVec2::new(p0.distance(p3), p0.distance(p1)),
            frame,
            scale: number(case, "scale")?,
            windows: ExactWindows(ExactTable {
                nx: n,
                ny: n,
                weights,
            }),
            picture: Picture {
                nx: n,
                ny: n,
                texels,
            },
        })
    }

    /// The texels of the picture in the frame of the rectangle.
    pub(crate) fn rectified(&self) -> &[DVec3] {
        &self.picture.texels
    }

    /// The place in the picture; none from behind.
    fn uv(&self, w: DVec3) -> Option<DVec2> {
        let w = self.frame.transpose() * w;
        (w.z > 0.0).then(|| square(w))
    }

    /// The part of the picture that a point sees.
    fn window(&self, p: DVec3, jitter: &mut Jitter) -> Option<[DVec2; 2]> {
        let magnitude = p.abs().max(self.corner.abs()).max_element();
        let low = self.frame.transpose() * jitter.vector(self.corner - p, magnitude);
        let high = low + self.size.extend(0.0);
        (low.z > 0.0)
            .then(|| [square(low), square(high)].map(|p| p.map(|x| jitter.at_scale(x, 1.0))))
    }

    fn pdf(&self, uv: DVec2, window: [DVec2; 2]) -> f64 {
        self.windows.pdf(uv, window) / solid_angle_per_area(direction(uv))
    }

    fn pdf_of_direction(&self, wi: DVec3, window: Option<[DVec2; 2]>, jitter: &mut Jitter) -> f64 {
        let uv = self.uv(jitter.vector(wi, 1.0));
        uv.zip(window)
            .map_or(0.0, |(uv, window)| self.pdf(uv, window))
    }

    /// Whether a direction runs along the rectangle, up to rounding.
    fn is_along(&self, d: DVec3, jitter: &mut Jitter) -> bool {
        let along = 8.0 * f64::from(f32::EPSILON);
        jitter.by(self.frame.z_axis.dot(d).abs(), 0.5 * along) <= along
    }

    /// The place for `u` in a window, a little off for the roundings of its sums.
    fn sample(&self, u: DVec2, window: [DVec2; 2], jitter: &mut Jitter) -> Option<DVec2> {
        let u = u.map(|x| jitter.at_scale(x, 1.0).clamp(0.0, 1.0));
        self.windows.sample(u, window)
    }
}

const WHOLE: [DVec2; 2] = [DVec2::ZERO, DVec2::ONE];

fn square(w: DVec3) -> DVec2 {
    (DVec2::new(f64::atan2(w.x, w.z), f64::atan2(w.y, w.z)) + FRAC_PI_2) / PI
}

fn direction(uv: DVec2) -> DVec3 {
    ((uv - 0.5) * PI).map(f64::tan).extend(1.0).normalize()
}

fn solid_angle_per_area(w: DVec3) -> f64 {
    PI * PI * (1.0 - w.x * w.x) * (1.0 - w.y * w.y) / w.z
}

/// The integral of the cosine to z over directions with angles between 0 and those of x and y.
fn cosine_up_to([a, b]: [f64; 2]) -> f64 {
    let part = |a: f64, b: f64| a.sin() * (b.tan() * a.cos()).atan();
    0.5 * (part(a, b) + part(b, a))
}

impl ExactLight for PortalSky {
    /// What passes the rectangle: each texel's integral of the cosine, times the area.
    fn phi(&self) -> DVec3 {
        let n = self.picture.nx;
        let angle = |i: usize| (i as f64 / n as f64 - 0.5) * PI;
        let up_to = |x: usize, y: usize| cosine_up_to([angle(x), angle(y)]);
        let mut sum = DVec3::ZERO;
        for (i, texel) in self.picture.texels.iter().enumerate() {
            let (x, y) = (i % n, i / n);
            sum += *texel * (up_to(x + 1, y + 1) - up_to(x, y + 1) - up_to(x + 1, y) + up_to(x, y));
        }
        self.scale * self.size.element_product() * sum
    }

    fn bounds(&self) -> Option<ExactBounds> {
        None
    }

    fn sample_li(&self, at: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<Arriving> {
        let window = self.window(at.p, jitter)?;
        let uv = self.sample(u, window, jitter)?;
        let near = uv
            .map(|x| jitter.at_scale(x, 1.0))
            .clamp(window[0], window[1]);
        let (pdf, l) = (
            self.pdf(near, window),
            self.scale * self.picture.nearest(near),
        );
        let wi = self.frame * direction(uv);
        (pdf > 0.0).then(|| self.scene.arriving(at, wi, uv, pdf, l))
    }

    fn pdf_li(&self, at: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        let window = self.window(at.p, jitter);
        self.pdf_of_direction(wi, window, jitter)
    }

    /// From the whole half space, and from the rectangle moved out of the scene.
    fn sample_le(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<Leaving> {
        let wi = self.frame * direction(self.sample(u1, WHOLE, jitter)?);
        if self.is_along(wi, jitter) {
            return None;
        }
        let on_portal = self.corner + self.frame * (u2 * self.size).extend(0.0);
        let away = self.scene.radius + on_portal.distance(self.scene.center);
        Some(Leaving {
            o: on_portal + away * wi,
            d: -wi,
            n: DVec3::ZERO,
            uv: DVec2::ZERO,
        })
    }

    fn sent(&self, ray: &Leaving, jitter: &mut Jitter) -> (DVec3, RayPdf) {
        let wi = jitter.vector(-ray.d, 1.0);
        let l = self
            .uv(wi)
            .map_or(DVec3::ZERO, |uv| self.picture.nearest(uv));
        let dir = self.uv(wi).map_or(0.0, |uv| self.pdf(uv, WHOLE));
        let across = self.size.element_product() * self.frame.z_axis.dot(wi).abs();
        (self.scale * l, [1.0 / across, dir])
    }

    fn pdf_le(&self, ray: &Leaving, jitter: &mut Jitter) -> RayPdf {
        let (_, [pos, dir]) = self.sent(ray, jitter);
        let magnitude = ray.o.abs().max(self.corner.abs()).max_element();
        let o = self.frame.transpose() * jitter.vector(ray.o - self.corner, 4.0 * magnitude);
        let d = self.frame.transpose() * jitter.vector(ray.d, 1.0);
        let at = (o - d * (o.z / d.z)).truncate();
        let is_through = at.cmpge(DVec2::ZERO).all()
            && at.cmple(self.size).all()
            && !self.is_along(ray.d, jitter);
        [if is_through { pos } else { 0.0 }, dir]
    }

    fn radiance(&self, ray: &Leaving, jitter: &mut Jitter) -> DVec3 {
        let uv = self.uv(jitter.vector(ray.d, 1.0));
        let Some((uv, [low, high])) = uv.zip(self.window(ray.o, jitter)) else {
            return DVec3::ZERO;
        };
        if uv.cmpge(low).all() && uv.cmple(high).all() {
            self.scale * self.picture.nearest(uv)
        } else {
            DVec3::ZERO
        }
    }
}
