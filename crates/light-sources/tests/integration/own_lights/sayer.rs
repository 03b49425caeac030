use alloc::sync::Arc;

use light_sources::glam::{Vec2, Vec3};
use light_sources::light_bounds::{InfiniteBounds, LightBounds, LightExtent, LightSampleContext};
use light_sources::*;

use super::{scene, set};

/// A light that says whatever it is told to.
#[derive(Clone, Copy)]
struct Sayer(LightType, LightExtent);

impl Light<Rgb> for Sayer {
    fn light_type(&self) -> LightType {
        self.0
    }

    fn phi(&self, (): &()) -> Vec3 {
        Vec3::ONE
    }

    fn sample_li(
        &self,
        _: &LightSampleContext,
        _: Vec2,
        (): &(),
        _: PdfCoverage,
    ) -> Option<LightLiSample<Vec3>> {
        None
    }

    fn pdf_li(&self, _: &LightSampleContext, _: Vec3, _: PdfCoverage) -> f32 {
        0.0
    }

    fn sample_le(&self, _: Vec2, _: Vec2, (): &()) -> Option<LightLeSample<Vec3>> {
        None
    }

    fn pdf_le(&self, _: &EmittedRay) -> LePdf {
        LePdf::default()
    }

    fn extent(&self) -> LightExtent {
        self.1
    }
}

impl AreaLight<Rgb> for Sayer {
    fn hit(&self, _: Vec3, _: Vec3) -> Option<SurfacePoint> {
        Some(SurfacePoint::default())
    }

    fn l(&self, _: &SurfacePoint, _: Vec3, (): &()) -> Vec3 {
        Vec3::ONE
    }
}

impl InfiniteLight<Rgb> for Sayer {
    fn le(&self, _: Vec3, _: Vec3, (): &()) -> Vec3 {
        Vec3::ONE
    }
}

#[test]
fn lights_that_contradict_themselves_are_refused() {
    let near = LightExtent::Bounded(LightBounds::EMPTY);
    let far = LightExtent::Infinite(InfiniteBounds::uniform(1.0));
    let ways: [fn(Sayer) -> OwnLight<Rgb>; 3] = [
        |light| OwnLight::Delta(Arc::new(light)),
        |light| OwnLight::Area(Arc::new(light)),
        |light| OwnLight::Infinite(Arc::new(light)),
    ];
    let types = [
        (LightType::DeltaPosition, 0, near),
        (LightType::DeltaDirection, 0, far),
        (LightType::Area, 1, near),
        (LightType::Infinite, 2, far),
    ];
    let mut builder = LightSetBuilder::new(scene());
    let mut taken = 0;
    for (light_type, fitting, fits) in types {
        for (way, own) in ways.iter().enumerate() {
            for extent in [near, far] {
                let result = builder.add(own(Sayer(light_type, extent)));
                let expected = if way != fitting {
                    Err(OwnLightError::Type)
                } else if extent != fits {
                    Err(OwnLightError::Extent)
                } else {
                    taken += 1;
                    Ok(SourceId(taken - 1))
                };
                let expected = expected.map_err(LightDescError::Own);
                assert_eq!(result, expected, "{light_type:?}, way {way}, {extent:?}");
            }
        }
    }
    assert_eq!((taken, builder.build().len()), (4, 4), "one of each type");
    let text = LightDescError::Own(OwnLightError::Extent).to_string();
    assert!(text.starts_with("own light, extent"), "{text}");
    let text = LightDescError::Own(OwnLightError::Type).to_string();
    assert!(text.starts_with("own light, light_type"), "{text}");
}

/// What only surfaces and skies answer, other own lights do not, whatever else they implement.
#[test]
fn rays_find_what_the_variant_says() {
    let near = LightExtent::Bounded(LightBounds::EMPTY);
    let far = LightExtent::Infinite(InfiniteBounds::uniform(1.0));
    let set = set([
        OwnLight::Delta(Arc::new(Sayer(LightType::DeltaPosition, near))).into(),
        OwnLight::Area(Arc::new(Sayer(LightType::Area, near))).into(),
        OwnLight::Infinite(Arc::new(Sayer(LightType::Infinite, far))).into(),
    ]);
    let owns = set.iter().filter(|(_, l)| matches!(l, LightRef::Own(_)));
    let answers: Vec<_> = owns
        .map(|(_, light)| {
            let at = SurfacePoint::default();
            let lit = [
                light.l(&at, Vec3::Z, &()),
                light.le(Vec3::ZERO, Vec3::Z, &()),
            ];
            (light.hit(Vec3::ZERO, Vec3::Z).is_some(), lit)
        })
        .collect();
    let none = Vec3::ZERO;
    let expected = [
        (false, [none, none]),
        (true, [Vec3::ONE, none]),
        (false, [none, Vec3::ONE]),
    ];
    assert_eq!(answers, expected, "by variant");
}

#[test]
fn the_memory_of_an_own_light_counts_once() {
    let light = Arc::new(Sayer(LightType::Area, LightBounds::EMPTY.into()));
    let bytes = |lights: usize| {
        let mut builder = LightSetBuilder::<Rgb>::new(scene());
        for _ in 0..lights {
            builder.add(OwnLight::Area(light.clone())).expect("a light");
        }
        builder.build().bytes().lights
    };
    let [one, two, three] = [1, 2, 3].map(bytes);
    assert_eq!(two - one, three - two, "where they are");
    assert_eq!(
        one - (two - one),
        size_of::<Sayer>() + 4,
        "the light, and one block of the table"
    );
    let text = format!("{:?}", OwnLight::<Rgb>::Area(light));
    assert!(
        text.starts_with("OwnLight { light_type: Area, extent: Bounded"),
        "{text}"
    );
}
