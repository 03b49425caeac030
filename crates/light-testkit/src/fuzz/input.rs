use arbitrary::Unstructured;
use light_bounds::{EmissionLobe, InfiniteBounds, LightBounds, LightExtent, LightSampleContext};
use light_math::glam::Vec3;
use light_math::{Aabb, DirectionCone};

/// Values read from the bytes of the fuzzer; zeros when they run out.
pub(super) struct Input<'a>(Unstructured<'a>);

impl<'a> Input<'a> {
    pub(super) fn new(data: &'a [u8]) -> Self {
        Self(Unstructured::new(data))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn u32(&mut self) -> u32 {
        self.0.arbitrary().unwrap_or_default()
    }

    pub(super) fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or_default()
    }

    /// Any float, NaN included.
    pub(super) fn f32(&mut self) -> f32 {
        f32::from_bits(self.u32())
    }

    /// A float that is no NaN and not infinite.
    pub(super) fn finite(&mut self) -> f32 {
        let x = self.f32();
        if x.is_finite() { x } else { 0.0 }
    }

    /// A random number in `[0, 1)`.
    pub(super) fn unit(&mut self) -> f32 {
        (self.u32() >> 8) as f32 / 16_777_216.0
    }

    /// A cosine.
    pub(super) fn cosine(&mut self) -> f32 {
        self.finite().clamp(-1.0, 1.0)
    }

    pub(super) fn point(&mut self) -> Vec3 {
        Vec3::new(self.finite(), self.finite(), self.finite())
    }

    /// A unit vector.
    pub(super) fn direction(&mut self) -> Vec3 {
        let v = self.point();
        // Scaled first, so that no square overflows or vanishes.
        (v / v.abs().max_element().max(f32::MIN_POSITIVE)).normalize_or(Vec3::Z)
    }

    pub(super) fn aabb(&mut self) -> Aabb {
        Aabb::new(self.point(), self.point())
    }

    /// Valid bounds of a light.
    pub(super) fn bounds(&mut self) -> LightBounds {
        let kind = self.byte();
        LightBounds {
            bounds: if kind & 1 == 0 {
                self.aabb()
            } else {
                Aabb::from_point(self.point())
            },
            w: self.direction(),
            phi: self.finite().abs(),
            cos_theta_o: self.cosine(),
            cos_theta_e: self.cosine(),
            two_sided: kind & 2 == 2,
        }
    }

    /// A light, now and then at infinity, now and then not valid.
    pub(super) fn extent(&mut self) -> LightExtent {
        match self.byte() % 16 {
            0 => LightExtent::Infinite(InfiniteBounds::uniform(self.finite().abs())),
            1 => LightExtent::Infinite(InfiniteBounds::distant(
                self.finite().abs(),
                self.direction(),
            )),
            2 => LightExtent::Infinite(InfiniteBounds {
                fluence: self.f32(),
                mean: Vec3::new(self.f32(), self.f32(), self.f32()),
                cone: DirectionCone::new(self.direction(), self.f32()),
            }),
            3 => LightExtent::Bounded(LightBounds {
                phi: self.f32(),
                cos_theta_e: self.f32(),
                ..self.bounds()
            }),
            4 => LightExtent::Lobe(
                self.bounds(),
                EmissionLobe {
                    power: self.finite().abs(),
                    mean: self.direction() * self.cosine(),
                    spread: self.f32(),
                },
            ),
            _ => LightExtent::Bounded(self.bounds()),
        }
    }

    pub(super) fn context(&mut self) -> LightSampleContext {
        let p = self.point();
        if self.byte() % 4 == 0 {
            LightSampleContext::medium(p)
        } else {
            let n = self.direction();
            LightSampleContext::surface(p, n, n)
        }
    }
}
