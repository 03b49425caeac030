use super::super::equal_area::{sphere_to_square, square_to_sphere, wrap};
use super::super::warp::SPHERE_PDF;
use super::exact_light::{Arriving, ExactBounds, ExactLight, Leaving, RayPdf, Receiver};
use super::fields::{number, transform};
use super::infinite::Scene;
use crate::oracle::Jitter;
use crate::oracle::table::ExactTable;
use crate::{Case, Malformed};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::PI;

/// Texels row by row.
#[derive(Clone, Debug)]
pub(super) struct Picture {
    pub(super) nx: usize,
    pub(super) ny: usize,
    pub(super) texels: Vec<DVec3>,
}

impl Picture {
    pub(super) fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        let image = case.get("image")?;
        let numbers = image.get("texels")?.floats()?;
        let channels = image.get("channels")?.index()?;
        let texels = numbers.chunks(channels).map(|texel| {
            let channel = |i: usize| f64::from(texel[i.min(channels - 1)]);
            DVec3::new(channel(0), channel(1), channel(2))
        });
        Ok(Self {
            nx: image.get("nx")?.index()?,
            ny: image.get("ny")?.index()?,
            texels: texels.collect(),
        })
    }

    /// The means of the channels.
    pub(super) fn averages(&self) -> ExactTable {
        ExactTable {
            nx: self.nx,
            ny: self.ny,
            weights: self.texels.iter().map(|t| t.element_sum() / 3.0).collect(),
        }
    }

    pub(super) fn mean(&self) -> DVec3 {
        self.texels.iter().sum::<DVec3>() / self.texels.len() as f64
    }

    pub(super) fn nearest(&self, uv: DVec2) -> DVec3 {
        let index = |x: f64, n: usize| ((x * n as f64).max(0.0) as usize).min(n - 1);
        self.texels[index(uv.x, self.nx) + self.nx * index(uv.y, self.ny)]
    }

    /// Interpolated between the centres of texels of an equal-area map, across its edges to the
    /// neighbours on the sphere.
    pub(super) fn bilinear(&self, uv: DVec2) -> DVec3 {
        let n = self.nx as i64;
        let t = uv * n as f64 - 0.5;
        let (low, part) = (t.floor(), t - t.floor());
        let texel = |dx: i64, dy: i64| {
            let [x, y] = wrap([low.x as i64 + dx, low.y as i64 + dy], n);
            self.texels[x + self.nx * y]
        };
        texel(0, 0)
            .lerp(texel(1, 0), part.x)
            .lerp(texel(0, 1).lerp(texel(1, 1), part.x), part.y)
    }
}

/// A picture of all directions.
pub(super) struct ImageSky {
    scene: Scene,
    to_scene: DMat3,
    scale: f64,
    picture: Picture,
    table: ExactTable,
    /// What is brighter than the mean.
    compensated: ExactTable,
}

impl ImageSky {
    pub(super) fn new(case: &Case<'_>) -> Result<Self, Malformed> {
        let picture = Picture::read(case)?;
        let table = picture.averages();
        let mean = table.mean();
        let mut compensated = table.clone();
        for weight in &mut compensated.weights {
            *weight = (*weight - mean).max(0.0);
        }
        if compensated.weights.iter().all(|&w| w == 0.0) {
            compensated.weights.fill(1.0);
        }
        Ok(Self {
            scene: Scene::read(case)?,
            to_scene: transform(&case.get("render_from_light")?)?.0,
            scale: number(case, "scale")?,
            picture,
            table,
            compensated,
        })
    }

    fn table(&self, at: &Receiver) -> &ExactTable {
        if at.is_incomplete {
            &self.compensated
        } else {
            &self.table
        }
    }

    fn uv(&self, wi: DVec3, jitter: &mut Jitter) -> DVec2 {
        sphere_to_square(jitter.vector(self.to_scene.transpose() * wi, 1.0))
    }
}

impl ExactLight for ImageSky {
    fn phi(&self) -> DVec3 {
        4.0 * PI * self.scene.disk() * self.scale * self.picture.mean()
    }

    fn bounds(&self) -> Option<ExactBounds> {
        None
    }

    fn sample_li(&self, at: &Receiver, u: DVec2, jitter: &mut Jitter) -> Option<Arriving> {
        let table = self.table(at);
        let uv = table.sample(u, jitter)?;
        let wi = self.to_scene * square_to_sphere(uv);
        // The place may round into the next texel.
        let near = uv.map(|x| jitter.at_scale(x, 1.0));
        let l = self.scale * self.picture.nearest(near);
        let pdf = table.pdf(near) * SPHERE_PDF;
        Some(self.scene.arriving(at, wi, uv, pdf, l))
    }

    fn pdf_li(&self, at: &Receiver, wi: DVec3, jitter: &mut Jitter) -> f64 {
        self.table(at).pdf(self.uv(wi, jitter)) * SPHERE_PDF
    }

    fn sample_le(&self, u1: DVec2, u2: DVec2, jitter: &mut Jitter) -> Option<Leaving> {
        let uv = self.table.sample(u1, jitter)?;
        let wi = self.to_scene * square_to_sphere(uv);
        Some(self.scene.leaving(wi, u2, jitter))
    }

    fn sent(&self, ray: &Leaving, jitter: &mut Jitter) -> (DVec3, RayPdf) {
        let uv = self.uv(-ray.d, jitter);
        let pdf = self.table.pdf(uv) * SPHERE_PDF;
        (
            self.scale * self.picture.nearest(uv),
            [1.0 / self.scene.disk(), pdf],
        )
    }

    fn radiance(&self, ray: &Leaving, jitter: &mut Jitter) -> DVec3 {
        self.scale * self.picture.nearest(self.uv(ray.d, jitter))
    }
}
