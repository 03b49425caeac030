use lights::glam::{Vec2, Vec3};
use lights::math::Aabb;
use obvhs::BvhBuildParams;
use obvhs::bvh2::Bvh2;
use obvhs::ray::{Ray as ObvhsRay, RayHit};

use super::Hit;
use super::build::{boxed, over_boxes};
use super::geometry::{Geometry, Numbers};
use super::instance_transform::InstanceTransform;
use super::quadric_shape::QuadricShape;
use crate::{PrimitiveId, Ray};

/// Triangles and quadrics in object space, stored once for any number of instances.
#[derive(Clone, Debug)]
pub struct Prototype {
    /// The corners of its triangles.
    pub triangles: Vec<[Vec3; 3]>,
    /// Its quadrics.
    pub quadrics: Vec<QuadricShape>,
    /// The transforms of its instances.
    pub transforms: Vec<InstanceTransform>,
}

/// Two-level hierarchy: a tree over the instances, above one geometry for each prototype.
#[derive(Default)]
pub(super) struct Instances {
    top: Bvh2,
    /// In the order of the leaves of `top`.
    instances: Vec<Instance>,
    prototypes: Vec<Geometry>,
}

/// A prototype with the transform that takes it to world space.
#[derive(Clone, Copy, Debug)]
struct Instance {
    transform: InstanceTransform,
    prototype: u32,
    /// Its position among the transforms of all prototypes.
    position: u32,
}

/// A ray in the object space of one instance.
struct Visit<'a> {
    geometry: &'a Geometry,
    instance: u32,
    ray: Ray,
    /// The length in object space of a unit of world space along the ray.
    stretch: f32,
    /// The number of the primitive that it starts on, if that belongs to this instance.
    from: Option<u32>,
}

impl Instances {
    /// All instances of `prototypes`, with primitives numbered from `next` on.
    pub(super) fn new(prototypes: Vec<Prototype>, mut next: Numbers) -> Self {
        let mut this = Self::default();
        let (mut instances, mut boxes) = (Vec::new(), Vec::new());
        let mut positions = 0u32..;
        for (prototype, stored) in (0u32..).zip(prototypes) {
            let Prototype {
                triangles,
                quadrics,
                transforms,
            } = stored;
            let geometry = Geometry::new(&triangles, &quadrics, &mut next);
            this.prototypes.push(geometry);
            let bounds = Aabb::from_points(triangles.as_flattened().iter().copied());
            let quadrics = quadrics.iter().map(QuadricShape::bounds);
            let bounds = quadrics.fold(bounds, Aabb::union);
            for (transform, position) in transforms.into_iter().zip(positions.by_ref()) {
                // Nothing can be hit in an empty prototype, but positions go on.
                if !bounds.is_empty() {
                    boxes.push(boxed(&transform.bounds(&bounds)));
                    instances.push(Instance {
                        transform,
                        prototype,
                        position,
                    });
                }
            }
        }
        if boxes.is_empty() {
            return this;
        }
        // Entering a prototype costs more than testing one more box.
        let params = BvhBuildParams {
            max_prims_per_leaf: 1,
            ..BvhBuildParams::medium_build()
        };
        this.top = over_boxes(&boxes, params);
        let slots = this.top.primitive_indices.iter();
        this.instances = slots.map(|&i| instances[i as usize]).collect();
        this
    }

    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.instances.is_empty()
    }

    pub(super) fn prototype_count(&self) -> usize {
        self.prototypes.len()
    }

    #[inline]
    pub(super) fn transform(&self, instance: u32) -> &InstanceTransform {
        &self.instances[instance as usize].transform
    }

    /// The position of an instance among the transforms of all prototypes, in their order.
    #[inline]
    pub(super) fn position(&self, instance: u32) -> u32 {
        self.instances[instance as usize].position
    }

    /// The geometry of every instance.
    pub(super) fn geometry(&self) -> impl ExactSizeIterator<Item = &Geometry> {
        let instances = self.instances.iter();
        instances.map(|instance| &self.prototypes[instance.prototype as usize])
    }

    /// The first hit of `ray` nearer than `t_max` that `any_hit` accepts.
    // Not inlined: most scenes have no instances.
    #[inline(never)]
    pub(super) fn closest(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<PrimitiveId>,
        any_hit: &impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> Option<Hit> {
        let mut closest = None;
        let mut intersect = |slot, t_max| {
            let visit = self.visit(ray, slot, from)?;
            let filter = |number, coords| any_hit(visit.id(number), coords);
            let t_max_object = t_max * visit.stretch;
            let hit = visit
                .geometry
                .closest(&visit.ray, t_max_object, visit.from, filter)?;
            let t = hit.t / visit.stretch;
            // The division may round up to `t_max` or beyond.
            (t < t_max).then(|| {
                closest = Some(Hit {
                    primitive: visit.id(hit.number),
                    t,
                    coords: hit.coords,
                });
                t
            })
        };
        let bare = ObvhsRay::new(ray.origin.into(), ray.direction.into(), 0.0, t_max);
        self.top
            .ray_traverse(bare, &mut RayHit::none(), |bare, slot| {
                intersect(slot, bare.tmax).unwrap_or(f32::INFINITY)
            });
        closest
    }

    /// Whether any hit that `any_hit` accepts is nearer than `t_max`.
    #[inline(never)]
    pub(super) fn occluded(
        &self,
        ray: &Ray,
        t_max: f32,
        from: Option<PrimitiveId>,
        any_hit: &impl Fn(PrimitiveId, Vec2) -> bool,
    ) -> bool {
        let blocks = |slot| {
            self.visit(ray, slot, from).is_some_and(|visit| {
                let filter = |number, coords| any_hit(visit.id(number), coords);
                let t_max_object = t_max * visit.stretch;
                visit
                    .geometry
                    .occluded(&visit.ray, t_max_object, visit.from, filter)
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

    /// `ray` in the object space of the instance in `slot`; `None` if its origin overflows there.
    #[inline]
    fn visit(&self, ray: &Ray, slot: usize, from: Option<PrimitiveId>) -> Option<Visit<'_>> {
        let Instance {
            transform,
            prototype,
            ..
        } = &self.instances[slot];
        let geometry = &self.prototypes[*prototype as usize];
        let instance = u32::try_from(slot).ok()?;
        let (ray, stretch) = transform.object_ray(ray);
        let from = from.filter(|from| from.instance() == Some(instance));
        ray.origin.is_finite().then(|| Visit {
            geometry,
            instance,
            ray,
            stretch,
            from: from.map(PrimitiveId::number),
        })
    }
}

impl Visit<'_> {
    fn id(&self, number: u32) -> PrimitiveId {
        PrimitiveId::in_instance(number, self.instance)
    }
}
