use lights::glam::{Vec2, Vec3};
use lights::math::Aabb;
use lights::sources::shape::{Shape, Sphere};
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::ray::{Ray as ObvhsRay, RayHit};

use super::Hit;
use super::boxed;
use super::build::over_boxes;
use super::place::Place;
use super::solids::{Numbers, Solids};
use crate::{PrimitiveId, Ray};

/// Triangles and spheres that stand in several places.
#[derive(Clone, Debug)]
pub struct Prototype {
    /// The corners of its triangles.
    pub triangles: Vec<[Vec3; 3]>,
    /// Its spheres.
    pub spheres: Vec<Sphere>,
    /// Where it stands.
    pub places: Vec<Place>,
}

/// Prototypes in their places: a hierarchy over the places, above one for each prototype.
#[derive(Default)]
pub(super) struct Placements {
    top: Bvh2,
    /// In the order of the leaves of `top`.
    placements: Vec<Placement>,
    prototypes: Vec<Solids>,
}

/// One place of a prototype.
#[derive(Clone, Copy, Debug)]
struct Placement {
    place: Place,
    prototype: u32,
}

/// A ray in the coordinates of one of the places.
struct Visit<'a> {
    solids: &'a Solids,
    placement: u32,
    ray: Ray,
    /// The length there of a scene unit along the ray.
    stretch: f32,
    /// The number of what it starts on, if that stands in this place.
    from: Option<u32>,
}

impl Placements {
    /// `prototypes` in all their places, numbered from `next` on.
    pub(super) fn new(prototypes: Vec<Prototype>, mut next: Numbers) -> Self {
        let mut this = Self::default();
        let (mut placements, mut boxes) = (Vec::new(), Vec::new());
        for (prototype, stored) in (0u32..).zip(prototypes) {
            let Prototype {
                triangles,
                spheres,
                places,
            } = stored;
            let solids = Solids::new(&triangles, &spheres, &mut next);
            this.prototypes.push(solids);
            let bounds = Aabb::from_points(triangles.as_flattened().iter().copied());
            let spheres = spheres.iter().map(Shape::bounds);
            let bounds = spheres.fold(bounds, Aabb::union);
            if !bounds.is_empty() {
                boxes.extend(places.iter().map(|place| boxed(&place.bounds(&bounds))));
                let placed = |place| Placement { place, prototype };
                placements.extend(places.into_iter().map(placed));
            }
        }
        if boxes.is_empty() {
            return this;
        }
        // A look into a prototype costs more than a look at one more box.
        let params = BvhBuildParams {
            max_prims_per_leaf: 1,
            ..BvhBuildParams::medium_build()
        };
        this.top = over_boxes(&boxes, params);
        let slots = this.top.primitive_indices.iter();
        this.placements = slots.map(|&i| placements[i as usize]).collect();
        this
    }

    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.placements.is_empty()
    }

    pub(super) fn prototype_count(&self) -> usize {
        self.prototypes.len()
    }

    #[inline]
    pub(super) fn place(&self, placement: u32) -> &Place {
        &self.placements[placement as usize].place
    }

    /// What stands in every place, place by place.
    pub(super) fn solids(&self) -> impl ExactSizeIterator<Item = &Solids> {
        let placements = self.placements.iter();
        placements.map(|placement| &self.prototypes[placement.prototype as usize])
    }

    /// The first hit of `ray` that is nearer than `t_max` and of which `is_there` says that it
    /// counts.
    // Kept out of the code that scenes without placements run.
    #[inline(never)]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<PrimitiveId>,
        is_there: &impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> Option<Hit> {
        let mut closest = None;
        let mut look = |slot, t_max| {
            let visit = self.visit(ray, slot, from)?;
            let there = |number, place| is_there(visit.id(number), place);
            let t_max_there = t_max * visit.stretch;
            let hit = visit
                .solids
                .closest(&visit.ray, t_max_there, visit.from, there)?;
            let t = hit.t / visit.stretch;
            // Rounding may have made it longer on the way back.
            (t < t_max).then(|| {
                closest = Some(Hit {
                    primitive: visit.id(hit.number),
                    t,
                    place: hit.place,
                });
                t
            })
        };
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        self.top
            .ray_traverse(bare, &mut RayHit::none(), |bare, slot| {
                look(slot, bare.tmax).unwrap_or(f32::INFINITY)
            });
        closest
    }

    /// Whether anything that counts is nearer than `t_max`.
    #[inline(never)]
    pub(super) fn occluded(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<PrimitiveId>,
        is_there: &impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> bool {
        let blocks = |slot| {
            self.visit(ray, slot, from).is_some_and(|visit| {
                let there = |number, place| is_there(visit.id(number), place);
                let t_max_there = t_max * visit.stretch;
                visit
                    .solids
                    .occluded(&visit.ray, t_max_there, visit.from, there)
            })
        };
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        !self.top.ray_traverse_miss(
            bare,
            |_, slot| {
                if blocks(slot) { 0.0 } else { f32::INFINITY }
            },
        )
    }

    /// `ray` as the placement in `slot` sees it; `None` where it would start beyond all numbers.
    #[inline]
    fn visit(&self, ray: &Ray, slot: usize, from: Option<PrimitiveId>) -> Option<Visit<'_>> {
        let Placement { place, prototype } = &self.placements[slot];
        let solids = &self.prototypes[*prototype as usize];
        let placement = u32::try_from(slot).ok()?;
        let (ray, stretch) = place.to_object(ray);
        let from = from.filter(|from| from.placement() == Some(placement));
        ray.origin.is_finite().then(|| Visit {
            solids,
            placement,
            ray,
            stretch,
            from: from.map(PrimitiveId::number),
        })
    }
}

impl Visit<'_> {
    fn id(&self, number: u32) -> PrimitiveId {
        PrimitiveId::placed(number, self.placement)
    }
}
