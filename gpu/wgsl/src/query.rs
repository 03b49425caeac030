//! Queries and answers, as the shader lays them out.

use bytemuck::{Pod, Zeroable};
use light_bounds::{Gloss, LightId, LightSampleContext};
use light_math::glam::{Vec2, Vec3};
use light_sets::BenchSet;

/// Kinds of receivers, in the order of the shader's constants.
const KINDS: [&str; 5] = ["surface", "two-sided", "glossy", "medium", "segment"];

/// Who asks for a light, by which random number, and whose probability is asked besides.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Query {
    p: [f32; 3],
    kind: u32,
    n: [f32; 3],
    alpha: f32,
    wo: [f32; 3],
    diffuse: f32,
    u: [u32; 2],
    other: u32,
    unused: u32,
}

/// What the shader chose.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Answer {
    pub light: u32,
    pub pmf: f32,
    /// Upper and lower word.
    pub u: [u32; 2],
    /// The probability of that light by a query of the shader.
    pub again: f32,
    /// That of the other light.
    pub other: f32,
    unused: [u32; 2],
}

/// What the shader made of a query by tables and maps.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Mapped {
    pub index: u32,
    pub pmf: f32,
    pub u: [u32; 2],
    pub decoded: [f32; 3],
    pub code: u32,
    pub direction: [f32; 3],
    unused: u32,
    pub place: [f32; 2],
    unused_too: [u32; 2],
}

/// What the shader says of the light of a query.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Arrived {
    pub l: [f32; 3],
    pub pdf: f32,
    pub wi: [f32; 3],
    /// The density of that direction by a query of the shader.
    pub again: f32,
    pub p_light: [f32; 3],
    /// That of the direction to the viewer.
    pub toward: f32,
    pub n_light: [f32; 3],
    /// The sum of the channels of what arrives along a ray in that direction.
    pub le: f32,
}

/// What the shader says of the bounds of a query's light.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Weighed {
    pub lower: [f32; 3],
    pub importance: f32,
    pub upper: [f32; 3],
    pub phi: f32,
    pub w: [f32; 3],
    pub cos_theta_o: f32,
    pub cos_theta_e: f32,
    pub two_sided: u32,
    unused: [u32; 2],
}

impl Query {
    /// Query `i` about the light `light`, at a point of a cube of the edge 4 about the origin, of
    /// each kind of receiver in turn. Some viewers are along an axis.
    pub fn about(light: u32, i: u32) -> Self {
        let mut random = Random(u64::from(i) << 8);
        let mut vector = || Vec3::new(random.unit(), random.unit(), random.unit()) * 2.0 - 1.0;
        let (p, n, wo) = (2.0 * vector(), vector(), vector().normalize());
        let axes = [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
        let wo = axes.get(i as usize % 64).map_or(wo, |&axis| axis);
        Self {
            p: p.to_array(),
            kind: i % KINDS.len() as u32,
            n: n.to_array(),
            alpha: 0.5,
            wo: wo.to_array(),
            diffuse: 0.5,
            u: [(); 2].map(|()| (random.next() >> 32) as u32),
            other: light,
            unused: 0,
        }
    }

    /// The same nearly within the plane through `center` with the unit normal `n`: on either side,
    /// as high as 1e-4 to 1e-3 of the coordinates.
    pub fn near_plane(mut self, center: Vec3, n: Vec3) -> Self {
        let p = Vec3::from(self.p);
        let [slope, side] = self.place().to_array();
        let slope = 1e-4 * 10f32.powf(slope) * (side - 0.5).signum();
        let height = (p.length() + center.length()) * slope;
        self.p = (p + n * (height - (p - center).dot(n))).to_array();
        self
    }

    /// The same with one or both random numbers at the ends of [0, 1).
    pub fn at_ends(mut self) -> Self {
        self.u = self.u.map(|word| match word % 4 {
            0 => 0,
            1 => u32::MAX,
            _ => word,
        });
        self
    }

    /// Whether a random number is at an end of [0, 1).
    pub fn is_at_end(&self) -> bool {
        self.u.iter().any(|&word| word == 0 || word == u32::MAX)
    }

    /// The direction to the viewer.
    pub fn wo(&self) -> Vec3 {
        self.wo.into()
    }

    /// The random numbers of a place, as the shader takes them.
    pub fn place(&self) -> Vec2 {
        let [x, y] = self.u.map(|word| (word >> 8) as f32 / 16_777_216.0);
        Vec2::new(x, y)
    }

    /// Query `i` of many about so many `lights` at the points of `set`, of each kind of receiver in
    /// turn.
    pub fn new(set: &BenchSet, lights: usize, i: u32) -> Self {
        let mut random = Random(u64::from(i) << 8);
        let mut next = || random.next();
        let at = &set.points[(next() % set.points.len() as u64) as usize];
        let (high, low) = (next(), next());
        let unit = |bits: u64| (bits >> 40) as f32 / 8_388_608.0 - 1.0;
        let wo = Vec3::new(unit(next()), unit(next()), unit(next()));
        let kind = i % KINDS.len() as u32;
        let other = &set.points[(next() % set.points.len() as u64) as usize];
        let n = if kind == 4 { other.p - at.p } else { at.n };
        Self {
            p: at.p.to_array(),
            kind,
            n: n.to_array(),
            alpha: (next() >> 40) as f32 / 16_777_216.0,
            wo: (wo * wo.dot(at.n).signum()).to_array(),
            diffuse: (next() >> 40) as f32 / 16_777_216.0,
            u: [(high >> 32) as u32, (low >> 32) as u32],
            other: (next() % lights as u64) as u32,
            unused: 0,
        }
    }

    /// The random number.
    pub const fn u(&self) -> u64 {
        light_math::fraction::from_words(self.u[0], self.u[1])
    }

    /// The random number of one of four choices.
    pub const fn u_of_four(&self) -> u64 {
        light_math::fraction::stratum(self.u[0] & 3, 4, self.u())
    }

    /// The normal, or the extent of a segment.
    pub fn n(&self) -> Vec3 {
        self.n.into()
    }

    /// The light whose probability is asked besides.
    pub const fn other(&self) -> LightId {
        LightId(self.other)
    }

    /// Who asks.
    pub fn context(&self) -> LightSampleContext {
        let [p, n, wo] = [self.p, self.n, self.wo].map(Vec3::from);
        let gloss = Gloss {
            wo,
            alpha: self.alpha,
            diffuse: self.diffuse,
        };
        match KINDS[self.kind as usize] {
            "surface" => LightSampleContext::surface(p, n, n),
            "two-sided" => LightSampleContext::two_sided(p, n, n),
            "glossy" => LightSampleContext::surface(p, n, n).with_gloss(gloss),
            "medium" => LightSampleContext::medium(p),
            _ => LightSampleContext::segment(p, n),
        }
    }
}

/// A row of random numbers.
pub struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mixed(self.0)
    }

    /// The next in [0, 1).
    pub fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / 16_777_216.0
    }
}

/// A hash of 64 bits.
const fn mixed(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}
