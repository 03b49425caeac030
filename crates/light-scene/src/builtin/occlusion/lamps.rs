use crate::builtin::dice::Dice;
use crate::builtin::modeller::Modeller;
use crate::glam::{Vec2, Vec3};
use crate::{Emission, Material, MaterialId};

/// How many radiances there are.
const LEVELS: u16 = 16;

/// From the weakest to the strongest radiance, in powers of ten.
const DECADES: f32 = 2.5;

/// The strongest radiance.
const BRIGHTEST: f32 = 60.0;

/// The lamps of a scene: one material for each radiance.
#[derive(Clone, Debug)]
pub(super) struct Lamps {
    levels: Vec<MaterialId>,
}

impl Lamps {
    /// The materials, in the scene of `modeller`.
    pub(super) fn new(modeller: &mut Modeller) -> Self {
        // Of the same green, so that they differ little in luminance.
        let tints = [
            Vec3::new(1.15, 1.0, 0.75),
            Vec3::new(1.05, 1.0, 0.9),
            Vec3::new(0.95, 1.0, 1.1),
        ];
        let level = |k: u16| {
            let decades = DECADES * (f32::from(k) / f32::from(LEVELS - 1) - 1.0);
            let tint = tints[usize::from(k) % tints.len()];
            modeller.material(Material {
                emission: Some(Emission::one_sided(
                    tint * (BRIGHTEST * 10f32.powf(decades)),
                )),
                ..Material::diffuse(format!("lamp {k}"), Vec3::splat(0.3))
            })
        };
        Self {
            levels: (0..LEVELS).map(level).collect(),
        }
    }

    /// Adds a lamp of any radiance that emits to the side of `u.cross(v)`; these lead from its
    /// centre to the middles of two of its edges.
    pub(super) fn add(
        &self,
        modeller: &mut Modeller,
        dice: &mut Dice,
        center: Vec3,
        [u, v]: [Vec3; 2],
    ) {
        let corners = [
            center - u - v,
            center + u - v,
            center + u + v,
            center - u + v,
        ];
        modeller.quad(dice.pick(&self.levels), corners);
    }

    /// Adds a square lamp of the given half width that emits to the side of the unit vector
    /// `toward`.
    pub(super) fn add_square(
        &self,
        modeller: &mut Modeller,
        dice: &mut Dice,
        center: Vec3,
        toward: Vec3,
        half: f32,
    ) {
        let (u, v) = toward.any_orthonormal_pair();
        self.add(modeller, dice, center, [u * half, v * half]);
    }
}

/// Places that are spread over a rectangle, each alone in a square cell.
#[derive(Clone, Debug)]
pub(super) struct Spread {
    /// The places, at least a quarter of a cell from its edges.
    pub(super) places: Vec<Vec2>,
    /// Half the width of a lamp that stays in its cell.
    pub(super) half: f32,
}

impl Spread {
    /// The widest lamps: half of it.
    const HALF: f32 = 0.12;

    /// `count` places in the rectangle from `min` to `max`.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and the number of places"
    )]
    pub(super) fn new(dice: &mut Dice, count: usize, [min, max]: [Vec2; 2]) -> Self {
        let size = max - min;
        let wide = (count as f32 * size.x / size.y).sqrt().ceil() as usize;
        let columns = wide.clamp(1, count.max(1));
        let rows = count.div_ceil(columns).max(1);
        let cell = size / Vec2::new(columns as f32, rows as f32);
        let cells = columns * rows;
        let place = |k: usize| {
            // Every so often a cell stays empty, so that rows do not end in a gap.
            let at = k * cells / count;
            let corner = Vec2::new((at % columns) as f32, (at / columns) as f32);
            let jitter = Vec2::new(dice.between(0.25, 0.75), dice.between(0.25, 0.75));
            min + (corner + jitter) * cell
        };
        Self {
            places: (0..count).map(place).collect(),
            half: (0.24 * cell.min_element()).min(Self::HALF),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_lie_within_and_apart() {
        for count in [1, 2, 7, 100, 999] {
            let ends = [Vec2::new(-3.0, 1.0), Vec2::new(5.0, 4.0)];
            let Spread { places, half } = Spread::new(&mut Dice::new(1), count, ends);
            assert_eq!(places.len(), count, "as many as asked for");
            for (i, &p) in places.iter().enumerate() {
                let inside = (p - half).cmpge(ends[0]) & (p + half).cmple(ends[1]);
                assert!(inside.all(), "{p} of {count} is inside");
                let is_apart = |&q: &Vec2| (p - q).abs().max_element() > 2.0 * half;
                assert!(places[..i].iter().all(is_apart), "{p} of {count} is alone");
            }
        }
    }

    #[test]
    fn lamps_emit_to_the_side_that_they_face() {
        let mut modeller = Modeller::default();
        let lamps = Lamps::new(&mut modeller);
        let toward = Vec3::new(0.6, -0.8, 0.0);
        lamps.add_square(&mut modeller, &mut Dice::new(1), Vec3::ONE, toward, 0.1);
        let scene = modeller.finish();
        let [a, b, c] = scene.meshes[0].triangle(0);
        assert!(
            (b - a).cross(c - a).normalize().dot(toward) > 0.999,
            "front"
        );
        assert!((scene.meshes[0].area() - 0.04).abs() < 1e-6, "0.2 x 0.2");
    }
}
