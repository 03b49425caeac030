use bytemuck::{Pod, Zeroable};
use light_bounds::{Gloss, LightId, LightSampleContext};
use light_math::fraction;
use light_math::glam::{Vec2, Vec3};

use crate::random::Random;

/// Kinds of receivers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Receiver {
    /// One side of a matt surface.
    Surface,
    /// Both sides of one.
    TwoSided,
    /// One side of a glossy surface.
    Glossy,
    /// A point in a medium.
    Medium,
    /// A segment of a ray in a medium.
    Segment,
}

impl Receiver {
    /// All kinds, by their number.
    pub const ALL: [Self; 5] = [
        Self::Surface,
        Self::TwoSided,
        Self::Glossy,
        Self::Medium,
        Self::Segment,
    ];
}

/// Who asks for a light, by which random number, and whose probability is asked besides: 64 bytes.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Query {
    /// The point.
    pub p: [f32; 3],
    /// A [`Receiver`].
    pub kind: u32,
    /// The normal of a surface, or the extent of a segment.
    pub n: [f32; 3],
    /// Roughness of a glossy surface.
    pub alpha: f32,
    /// The direction to the viewer.
    pub wo: [f32; 3],
    /// The matt share of a glossy surface.
    pub diffuse: f32,
    /// Upper and lower word of the random number.
    pub u: [u32; 2],
    /// The light whose probability is asked.
    pub other: u32,
    /// Nothing.
    pub unused: u32,
}

impl Query {
    /// A query of this kind at `p`, of the normal or extent `n`, about one of so many `lights`.
    #[must_use]
    pub fn new(kind: Receiver, p: Vec3, n: Vec3, lights: u32, random: &mut Random) -> Self {
        let wo = Vec3::new(random.signed(), random.signed(), random.signed());
        let u = random.bits();
        Self {
            p: p.to_array(),
            kind: kind as u32,
            n: n.to_array(),
            alpha: random.unit(),
            wo: (wo * wo.dot(n).signum()).to_array(),
            diffuse: random.unit(),
            u: [(u >> 32) as u32, u as u32],
            other: fraction::choose(lights, random.bits()).0,
            unused: 0,
        }
    }

    /// The random number.
    #[must_use]
    pub const fn u(&self) -> u64 {
        fraction::from_words(self.u[0], self.u[1])
    }

    /// The random number as a place of the unit square.
    #[must_use]
    pub fn place(&self) -> Vec2 {
        let [x, y] = self.u.map(|word| (word >> 8) as f32 / 16_777_216.0);
        Vec2::new(x, y)
    }

    /// The light whose probability is asked.
    #[must_use]
    pub const fn other(&self) -> LightId {
        LightId(self.other)
    }

    /// Who asks.
    #[must_use]
    pub fn context(&self) -> LightSampleContext {
        let [p, n, wo] = [self.p, self.n, self.wo].map(Vec3::from);
        let (alpha, diffuse) = (self.alpha, self.diffuse);
        match self.kind {
            0 => LightSampleContext::surface(p, n, n),
            1 => LightSampleContext::two_sided(p, n, n),
            2 => LightSampleContext::surface(p, n, n).with_gloss(Gloss { wo, alpha, diffuse }),
            3 => LightSampleContext::medium(p),
            _ => LightSampleContext::segment(p, n),
        }
    }
}
