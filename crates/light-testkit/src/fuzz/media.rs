use light_math::Aabb;
use light_math::glam::{Affine3A, Quat, Vec2, Vec3};
use light_media::phase::{
    HenyeyGreenstein, Isotropic, MieHazy, MieMurky, Phase, PhaseFunction, Rayleigh, Schlick,
};
use light_media::{
    AnyMedium, ColorGrid, ColorGridMedium, DensityGrid, ExponentialHeight, Glow, Grid, GridMedium,
    Homogeneous, Medium, Ray, Region, Span, StepSize, Substance, TemperatureGrid, delta_tracking,
    emission, transmittance,
};
use light_sources::Rgb;

use super::input::Input;
use crate::Rng;
use crate::edge_cases::EDGES_OF_U;

/// The largest coordinate and size of a medium.
const LARGEST: f32 = 1e4;

/// The largest coefficient, per unit length.
const DENSEST: f32 = 1e3;

/// The optical thickness up to which light is tracked: each unit of it is a collision.
const THICKEST: f32 = 1e4;

/// Steps of a march.
const STEPS: f32 = 32.0;

/// Transmittances are in `[0, 1]` by every method, and no tracked or marched result is infinite or
/// negative.
///
/// # Panics
/// If a guarantee is violated.
pub fn media(data: &[u8]) {
    let mut input = Input::new(data);
    let phase = phase(&mut input);
    for _ in 0..2 {
        check_phase(&phase, input.axis(), Vec2::new(input.unit(), input.unit()));
    }
    let ray = Ray {
        o: place(&mut input),
        d: input.axis(),
    };
    let (t0, length) = (input.amount(LARGEST), input.amount(f32::MAX));
    let Some(span) = Span::new(t0, t0 + length) else {
        return;
    };
    let seed = input.u32();
    if let Some(medium) = medium(&mut input, phase) {
        check_coefficients(&medium, &ray, span);
        check_light(&medium, &ray, span, seed);
    }
}

fn place(input: &mut Input<'_>) -> Vec3 {
    let largest = Vec3::splat(LARGEST);
    input.place().clamp(-largest, largest)
}

fn phase(input: &mut Input<'_>) -> Phase {
    let (kind, g) = (input.byte() % 6, input.cosine());
    match kind {
        0 => HenyeyGreenstein::new(g).map(Phase::HenyeyGreenstein),
        1 => Schlick::new(g).map(Phase::Schlick),
        2 => Schlick::from_asymmetry(g).map(Phase::Schlick),
        3 => Ok(Phase::Rayleigh(Rayleigh)),
        4 => Ok(Phase::MieHazy(MieHazy)),
        _ => Ok(Phase::MieMurky(MieMurky)),
    }
    .unwrap_or(Phase::Isotropic(Isotropic))
}

/// A sample is a unit vector whose density is the value there.
fn check_phase(phase: &Phase, wo: Vec3, u: Vec2) {
    let cos = phase.sample_cos(u.x);
    assert!(
        (-1.0..=1.0).contains(&cos),
        "{phase:?}: cosine {cos} for {u}"
    );
    let sample = phase.sample(wo, u);
    assert!(
        (sample.wi.length() - 1.0).abs() < 1e-5 && sample.pdf > 0.0 && sample.pdf.is_finite(),
        "{phase:?}: {sample:?} for {u} from {wo}"
    );
    let asked = phase.pdf(wo, sample.wi);
    // A cosine in f32 is off by some units in the last place, which a sharp peak magnifies.
    let off = 8.0 * f32::EPSILON;
    let values = [cos - off, cos, cos + off].map(|c| phase.value(c.clamp(-1.0, 1.0)));
    let low = values.into_iter().fold(f32::INFINITY, f32::min);
    let high = values.into_iter().fold(0.0, f32::max);
    assert!(
        asked >= low * 0.999 && asked <= high * 1.001,
        "{phase:?}: {sample:?} for {u} from {wo}, but the value is {asked}"
    );
}

/// Any medium; `None` where its description is refused.
fn medium(input: &mut Input<'_>, phase: Phase) -> Option<AnyMedium<Rgb>> {
    let kind = input.byte();
    let to_scene = Affine3A::from_scale_rotation_translation(
        scale(input),
        Quat::from_rotation_arc(Vec3::Z, input.axis()),
        place(input),
    );
    let bounds = Aabb::new(place(input), place(input));
    let region = if kind & 8 == 0 {
        Region::UNBOUNDED
    } else {
        Region::new(bounds, to_scene).ok()?
    };
    match kind % 4 {
        0 => Some(AnyMedium::Homogeneous(Homogeneous {
            substance: substance(input)?,
            phase,
            region,
        })),
        1 => {
            let substance = substance(input)?;
            // Steeper, and the rounding of a height of 10^4 shows in the density.
            let (base, up, falloff) = (place(input), input.place(), input.amount(2.0));
            let medium = ExponentialHeight::new(substance, phase, region, base, up, falloff);
            Some(medium.ok()?.into())
        }
        2 => {
            let substance = substance(input)?;
            let (size, values) = samples::<1>(input);
            let density = DensityGrid::new(size, values).ok()?;
            let glow = glow(input, kind)?;
            let medium = GridMedium::new(substance, phase, bounds, to_scene, density, glow);
            Some(medium.ok()?.into())
        }
        _ => {
            let mut grid = || {
                let (size, values) = samples::<3>(input);
                ColorGrid::new([Vec3::X, Vec3::Y, Vec3::Z], Grid::new(size, values).ok()?).ok()
            };
            let (sigma_a, sigma_s) = (grid()?, grid()?);
            let le = if kind & 16 == 0 { None } else { grid() };
            let medium = ColorGridMedium::new(sigma_a, sigma_s, le, phase, bounds, to_scene);
            Some(medium.ok()?.into())
        }
    }
}

fn scale(input: &mut Input<'_>) -> Vec3 {
    match input.byte() % 3 {
        0 => Vec3::ONE,
        _ => Vec3::new(input.number(), input.number(), input.number())
            .clamp(Vec3::splat(-LARGEST), Vec3::splat(LARGEST)),
    }
}

fn substance(input: &mut Input<'_>) -> Option<Substance<Rgb>> {
    let mut color = || {
        Vec3::new(
            input.amount(DENSEST),
            input.amount(DENSEST),
            input.amount(DENSEST),
        )
    };
    Substance::new(color(), color(), color()).ok()
}

/// A few samples, many of them zero.
fn samples<const K: usize>(input: &mut Input<'_>) -> ([u32; 3], Vec<f32>) {
    let size = [0; 3].map(|_: u32| input.below(3) as u32 + 1);
    let count = size.iter().product::<u32>() as usize * K;
    let sample = |byte: u8| {
        if byte < 64 {
            0.0
        } else {
            f32::from(byte - 63) / 16.0
        }
    };
    (size, (0..count).map(|_| sample(input.byte())).collect())
}

fn glow(input: &mut Input<'_>, kind: u8) -> Option<Glow<Rgb, Vec<f32>>> {
    Some(match kind >> 6 {
        0 => Glow::uniform(),
        1 => {
            let (size, values) = samples::<1>(input);
            Glow::scaled(Grid::new(size, values).ok()?)
        }
        _ => {
            let (size, values) = samples::<1>(input);
            let kelvin = values.into_iter().map(|x| x * 500.0).collect();
            Glow::of_temperature(TemperatureGrid::new(Grid::new(size, kelvin).ok()?))
        }
    })
}

fn is_light(l: Vec3) -> bool {
    l.is_finite() && l.min_element() >= 0.0
}

/// The medium lies in its segments, and its density nowhere exceeds their bounds.
fn check_coefficients(medium: &AnyMedium<Rgb>, ray: &Ray, span: Span) {
    let at = || format!("{ray:?}, {span:?} in {medium:?}");
    let Some(inside) = medium.clip(ray, span) else {
        return;
    };
    assert!(
        inside.t0 >= span.t0 && inside.t1 <= span.t1 && inside.t0 < inside.t1,
        "{inside:?} of {}",
        at()
    );
    if let Some(thickness) = medium.optical_thickness(ray, inside, &()) {
        let is_amount = thickness.min_element() >= 0.0;
        assert!(is_amount, "thickness {thickness} of {}", at());
    }
    let mut reached = inside.t0;
    for segment in medium.majorants(ray, inside, &()).take(1000) {
        assert!(
            segment.span.t0 == reached && segment.span.t1 >= reached && segment.sigma_maj >= 0.0,
            "{segment:?} after {reached} of {}",
            at()
        );
        reached = segment.span.t1;
        for share in [0.0, 0.3, 1.0] {
            let t = segment.span.t0 + share * segment.span.length();
            let here = medium.coefficients(ray.at(t), &());
            let parts = [here.sigma_a, here.sigma_s, here.emission];
            assert!(
                parts.into_iter().all(is_light),
                "{here:?} at {t} of {}",
                at()
            );
            let sigma_t = here.sigma_t().max_element();
            let is_bounded = sigma_t <= segment.sigma_maj * 1.01;
            assert!(is_bounded, "{sigma_t} at {t} in {segment:?} of {}", at());
        }
    }
}

/// Marched, tracked and in closed form.
fn check_light(medium: &AnyMedium<Rgb>, ray: &Ray, span: Span, seed: u32) {
    let at = || format!("{ray:?}, {span:?}, seed {seed} in {medium:?}");
    let is_share = |x: Vec3| x.min_element() >= 0.0 && x.max_element() <= 1.0;
    let Ok(step) = StepSize::new((span.length() / STEPS).min(LARGEST)) else {
        return;
    };
    // Often an edge: first of all, and now and then later.
    let mut rng = Rng::new(u64::from(seed >> 8));
    let mut next_u = || match rng.below(16) {
        0 => EDGES_OF_U[seed as usize % EDGES_OF_U.len()],
        _ => rng.f32(),
    };
    if let Some(left) = transmittance::closed_form(medium, ray, span, &()) {
        assert!(is_share(left), "{left} is left of {}", at());
    }
    let is_short = medium
        .clip(ray, span)
        .is_none_or(|inside| inside.length() / step.length() <= 2.0 * STEPS);
    if is_short {
        let left = transmittance::march(medium, ray, span, step, next_u(), &());
        assert!(is_share(left), "{left} is left of a march through {}", at());
        let best = transmittance::best(medium, ray, span, step, &(), &mut next_u);
        assert!(is_share(best), "{best} is left at best of {}", at());
        let glow = emission(medium, ray, span, step, &(), &mut next_u);
        assert!(
            is_light(glow.l) && is_light(glow.transmittance),
            "{glow:?} of {}",
            at()
        );
    }
    let thickness: f32 = medium.clip(ray, span).map_or(0.0, |inside| {
        let segments = medium.majorants(ray, inside, &()).take(1000);
        segments.map(|s| s.sigma_maj * s.span.length()).sum()
    });
    if thickness <= THICKEST {
        let left = transmittance::ratio_tracking(medium, ray, span, &(), &mut next_u);
        assert!(is_light(left), "{left} is tracked of {}", at());
        let flight = delta_tracking(medium, ray, span, Vec3::ONE, &(), &mut next_u);
        let is_inside = |t: f32| t >= span.t0 && t <= span.t1;
        assert!(
            is_light(flight.weight)
                && is_light(flight.emitted)
                && flight.scattered_at.is_none_or(is_inside),
            "{flight:?} of {}",
            at()
        );
    }
}
