//! What is said of a picture that shows less than its maker hoped for.

use light_scene::Image;
use lights::glam::Vec3;
use lights::math::spectrum::rec709_luminance;

use crate::exact_sum::LARGEST_TERM;
use crate::{Film, LightInventory, ToneMap};

/// Lamps that give less than this part of the light of the skies are said to be lost under them.
const LOST: f64 = 1e-4;

/// Of a picture with at least this share of white it is said: lamps in view are far less.
const MUCH: f64 = 0.1;

/// What to say of a picture some of whose pixels the film cannot hold.
pub(crate) fn of_range(film: &Film) -> Option<String> {
    let pixels = film.clipped_pixels();
    (pixels > 0).then(|| {
        format!(
            "radiance above {LARGEST_TERM:.1e} is clipped, in {pixels} pixels: try --light-scale \
             or --env-scale"
        )
    })
}

/// What to say of a picture without light.
pub(crate) fn of_black(image: &Image) -> Option<String> {
    let is_black = image.texels().iter().all(|&texel| texel == Vec3::ZERO);
    is_black.then(|| {
        "the picture is black: no light reaches what the camera sees. Try another camera \
         (--look-at), a sky (--sky overcast), or longer paths (--max-depth)"
            .to_owned()
    })
}

/// What to say of a picture that a screen shows as one black or one white area.
pub(crate) fn of_shown(image: &Image, tone_map: &ToneMap) -> Option<String> {
    let mut shown = image.texels().iter().map(|&texel| tone_map.apply(texel));
    let first = shown.next()?;
    // The eight bits of a screen, which show the square root of light, about.
    let is_black = |c: Vec3| c.max_element() < 1.5e-4;
    let words = match first {
        first if is_black(first) && shown.all(is_black) => "all black",
        first if is_white(first) && shown.all(is_white) => "all white",
        _ => return None,
    };
    Some(format!(
        "the picture is {words} as it is shown: try --exposure auto; an .exr file keeps all of it"
    ))
}

/// What to say of a picture much of which a screen shows as white.
pub(crate) fn of_clipped(image: &Image, tone_map: &ToneMap) -> Option<String> {
    let shown = image.texels().iter().map(|&texel| tone_map.apply(texel));
    let white = shown.filter(|&c| is_white(c)).count();
    let share = white as f64 / image.texels().len() as f64;
    (share >= MUCH).then(|| {
        format!(
            "{:.0} % of the picture is white as it is shown: try --exposure auto; an .exr file \
             keeps all of it",
            100.0 * share
        )
    })
}

/// Whether a screen shows this as white.
fn is_white(shown: Vec3) -> bool {
    shown.min_element() > 0.99
}

/// What to say of lamps that nobody sees under the sky.
pub(crate) fn of_lamps(kinds: &[LightInventory]) -> Option<String> {
    let is_sky =
        |kind: &LightInventory| matches!(kind.kind, "sun" | "uniform sky" | "image sky" | "portal");
    let power = |skies: bool| {
        let kinds = kinds.iter().filter(|kind| is_sky(kind) == skies);
        let powers = kinds.map(|kind| f64::from(rec709_luminance(kind.power.as_vec3())));
        powers.sum::<f64>()
    };
    let (skies, lamps) = (power(true), power(false));
    (lamps > 0.0 && lamps < LOST * skies).then(|| {
        let share = lamps / skies;
        format!(
            "all lamps together give {share:.0e} times the light of the sky, and will hardly be \
             seen: try --env-scale {:.0e}, or --light-scale",
            100.0 * share
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::glam::DVec3;

    fn image(texels: [f32; 2]) -> Image {
        let texels = texels.map(Vec3::splat).to_vec();
        Image::new(2, 1, texels).expect("two texels")
    }

    #[test]
    fn black_pictures_are_doubted() {
        assert!(of_black(&image([0.0; 2])).is_some(), "black");
        assert_eq!(of_black(&image([0.0, 1e-20])), None, "almost black");
    }

    #[test]
    fn pictures_that_show_nothing_are_doubted() {
        let doubt = |texels, exposure| of_shown(&image(texels), &ToneMap::new(exposure));
        let words = |doubt: Option<String>| doubt.expect("a doubt");
        assert!(
            words(doubt([1e-6, 1e-5], 1.0)).contains("all black"),
            "too dark"
        );
        assert!(
            words(doubt([1e3, 1e4], 1.0)).contains("all white"),
            "too bright"
        );
        assert_eq!(doubt([1e3, 1e4], 1e-4), None, "well exposed");
        assert_eq!(doubt([0.0, 1e4], 1.0), None, "both");
    }

    #[test]
    fn pictures_with_much_white_are_doubted() {
        let doubt = |white: u16| {
            let texel = |i| Vec3::splat(if i < white { 1e3 } else { 0.1 });
            let image = Image::new(100, 1, (0..100).map(texel).collect());
            of_clipped(&image.expect("texels"), &ToneMap::new(1.0))
        };
        let words = doubt(37).expect("a doubt");
        for word in ["37 % of the picture is white", "--exposure auto"] {
            assert!(words.contains(word), "{word} in {words}");
        }
        assert_eq!(doubt(9), None, "lamps in view");
    }

    #[test]
    fn lamps_under_a_bright_sky_are_doubted() {
        let kind = |kind, power| LightInventory {
            kind,
            count: 1,
            power: DVec3::splat(power),
            ..LightInventory::default()
        };
        let lost = of_lamps(&[kind("point", 1.0), kind("image sky", 1e5)]);
        let expected = "give 1e-5 times the light of the sky";
        assert!(lost.expect("a doubt").contains(expected), "named");
        let seen = of_lamps(&[kind("point", 1.0), kind("image sky", 1e3)]);
        assert_eq!(seen, None, "a lamp that is seen");
        for alone in ["point", "uniform sky"] {
            assert_eq!(of_lamps(&[kind(alone, 1.0)]), None, "{alone}");
        }
    }
}
