use light_scene::{Color, Surface as Finish};
use lights::glam::Vec3;

use super::World;
use crate::{Surface, sobol};

/// The surface of a mixture whose part does not come before it.
const BLACK: &Finish = &Finish::Diffuse {
    reflectance: Color::Constant(Vec3::ZERO),
};

impl World {
    /// The scattering of the surface: for a mixture one of its parts, chosen by a hash of the
    /// position, so that all queries at the same point get the same result.
    ///
    /// # Source
    /// `[PBRT4]`, section 10.5.1.
    #[inline]
    pub(crate) fn finish(&self, surface: &Surface) -> &Finish {
        let (mut id, _) = self.material(surface.primitive);
        while let Finish::Mix { materials, amount } = &self.materials[id].surface {
            let amount = self.color(amount, surface.uvs()).x;
            let second = chance(surface.p, id) < amount;
            let next = materials[usize::from(second)].0 as usize;
            // Ids only decrease, so that the loop ends.
            if next >= id {
                return BLACK;
            }
            id = next;
        }
        &self.materials[id].surface
    }
}

/// A pseudorandom number in `[0, 1)`, a hash of a position and a material.
#[expect(clippy::cast_possible_truncation, reason = "any bits will do")]
fn chance(p: Vec3, material: usize) -> f32 {
    let bits = p.to_array().map(f32::to_bits);
    let hash = bits.into_iter().fold(material as u32, |hash, bits| {
        sobol::hash(hash.rotate_left(9) ^ bits)
    });
    (hash >> 8) as f32 / (1u32 << 24) as f32
}
