use arbitrary::Unstructured;
use light_bounds::{
    EmissionLobe, Gloss, InfiniteBounds, LightBounds, LightExtent, LightSampleContext,
};
use light_math::glam::Vec3;
use light_math::{Aabb, DirectionCone, fraction};

/// Values read from the bytes of the fuzzer; zeros when they run out.
pub(super) struct Input<'a> {
    bytes: Unstructured<'a>,
    /// Whether numbers and places are whole sixteenths below 8 from here on: sizes whose ratios
    /// `f32` knows to many digits.
    pub(super) is_tame: bool,
}

impl<'a> Input<'a> {
    pub(super) fn new(data: &'a [u8]) -> Self {
        Self {
            bytes: Unstructured::new(data),
            is_tame: false,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    pub(super) fn u32(&mut self) -> u32 {
        self.bytes.arbitrary().unwrap_or_default()
    }

    pub(super) fn byte(&mut self) -> u8 {
        self.bytes.arbitrary().unwrap_or_default()
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

    /// An index below `n`.
    pub(super) fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// A finite number, mostly of a size that scenes have: a few steps of 2^-8, a power of two or
    /// its neighbour, or any float.
    pub(super) fn number(&mut self) -> f32 {
        if self.is_tame {
            return f32::from(i8::from_le_bytes([self.byte()])) / 16.0;
        }
        let (kind, low) = (self.byte(), self.byte());
        let sign = if kind & 8 == 0 { 1.0 } else { -1.0 };
        match kind & 7 {
            0 => 0.0,
            1..=4 => {
                let steps = i16::from_le_bytes([low, self.byte()]);
                f32::from(steps) / 4096.0
            }
            5 => sign * f32::from(low),
            6 => {
                let exponent = u32::from(low).clamp(1, 254) << 23;
                let neighbour = u32::from(kind >> 4 & 3).saturating_sub(1);
                sign * f32::from_bits(exponent - neighbour)
            }
            _ => self.finite(),
        }
    }

    /// A number from 0 to `largest`, mostly of a size that scenes have.
    pub(super) fn amount(&mut self, largest: f32) -> f32 {
        self.number().abs().min(largest)
    }

    /// A point of a scene.
    pub(super) fn place(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    /// A unit vector, often an axis or near one.
    pub(super) fn axis(&mut self) -> Vec3 {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z];
        let kind = self.byte();
        let sign = if kind & 8 == 0 { 1.0 } else { -1.0 };
        match kind & 7 {
            0..=2 => sign * axes[usize::from(kind & 3)],
            3 => {
                let v = axes[usize::from(kind >> 4) % 3] * sign;
                (v + self.place() * 1e-6).normalize_or(Vec3::Z)
            }
            _ => {
                let v = self.place();
                (v / v.abs().max_element().max(f32::MIN_POSITIVE)).normalize_or(Vec3::Z)
            }
        }
    }

    /// The cosine of an angle, often a right one or none.
    pub(super) fn angle_cosine(&mut self) -> f32 {
        match self.byte() % 8 {
            0 => 1.0,
            1 => 0.0,
            2 => -1.0,
            3 => self.cosine(),
            _ => 2.0 * self.unit() - 1.0,
        }
    }

    /// Valid bounds of a light as scenes have them.
    fn scene_bounds(&mut self) -> LightBounds {
        let kind = self.byte();
        // As far as the default tree takes them.
        let far = Vec3::splat(1e36);
        let p = self.place().clamp(-far, far);
        LightBounds {
            bounds: if kind & 1 == 0 {
                Aabb::from_point(p)
            } else {
                Aabb::new(p, self.place().clamp(-far, far))
            },
            w: self.axis(),
            phi: if kind & 12 == 12 {
                self.finite().abs()
            } else {
                self.amount(1e30)
            },
            cos_theta_o: self.angle_cosine(),
            cos_theta_e: self.angle_cosine(),
            two_sided: kind & 2 == 2,
        }
    }

    /// A valid light as scenes have it, now and then at infinity.
    pub(super) fn scene_extent(&mut self) -> LightExtent {
        match self.byte() % 12 {
            0 => LightExtent::Infinite(InfiniteBounds::uniform(self.amount(1e30))),
            1 => LightExtent::Infinite(InfiniteBounds::distant(self.amount(1e30), self.axis())),
            2 => {
                let (w, cos_theta) = (self.axis(), self.angle_cosine());
                LightExtent::Infinite(InfiniteBounds {
                    fluence: self.amount(1e30),
                    mean: w * self.unit(),
                    cone: DirectionCone::new(w, cos_theta),
                })
            }
            3 => {
                let bounds = self.scene_bounds();
                let lobe = EmissionLobe {
                    power: bounds.phi,
                    mean: self.axis() * self.unit(),
                    spread: self.unit(),
                };
                LightExtent::Lobe(bounds, lobe)
            }
            _ => LightExtent::Bounded(self.scene_bounds()),
        }
    }

    /// Any receiver: on a surface of one or two sides, matt or glossy, in a medium, along a ray
    /// segment; now and then with normals that are none.
    pub(super) fn receiver(&mut self) -> LightSampleContext {
        let (kind, p) = (self.byte(), self.place());
        let n = self.axis();
        let ns = match kind >> 4 {
            0 => Vec3::new(self.f32(), self.f32(), self.f32()),
            1 => Vec3::splat(f32::NAN),
            2 => n * self.number(),
            3 => self.axis(),
            _ => n,
        };
        match kind & 7 {
            0 => LightSampleContext::medium(p),
            1 => LightSampleContext::segment(p, self.place()),
            2 => LightSampleContext::two_sided(p, n, ns),
            3 => LightSampleContext::surface(p, n, ns).with_gloss(Gloss {
                wo: self.axis(),
                alpha: self.amount(1.0).max(1e-4),
                diffuse: self.unit(),
            }),
            4 => LightSampleContext::surface(p, ns, ns).with_error(self.place().abs()),
            _ => LightSampleContext::surface(p, n, ns),
        }
    }

    /// A random number in `[0, 1)`.
    pub(super) fn unit(&mut self) -> f32 {
        (self.u32() >> 8) as f32 / 16_777_216.0
    }

    /// A random number of 64 bits, of which the upper 24 are those of [`unit`](Self::unit).
    pub(super) fn fraction(&mut self) -> u64 {
        let high = self.u32();
        fraction::from_words(high, high.wrapping_mul(0x9e37_79b9))
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
