use super::course::{Bank, Course};
use super::lantern;
use super::measures::{FRONTS, QUAY};
use super::palette::Palette;
use crate::MaterialId;
use crate::builtin::modeller::Modeller;
use crate::glam::Vec3;

/// Radius of a bulb.
const BULB: f32 = 0.06;

/// From bulb to bulb along a string, in metres.
const SPACING: f32 = 0.5;

/// Where strings of many colours cross the canal, from house to house.
const CROSSINGS: [f32; 4] = [10.0, 20.0, 47.0, 77.0];

/// Strings of bulbs: from lantern to lantern along both quays, and across the canal.
pub(super) fn festoons(modeller: &mut Modeller, palette: &Palette, course: &Course) {
    for bank in Bank::BOTH {
        for pair in lantern::places(course, bank).windows(2) {
            let ends = [pair[0], pair[1]]
                .map(|along| lantern::foot(course, bank, along) + Vec3::Y * lantern::GLASS);
            if ends[0].distance(ends[1]) < 1.5 * lantern::SPACING {
                let amber = &palette.festoon[..1];
                string(modeller, palette, amber, ends, 0.7);
            }
        }
    }
    for along in CROSSINGS {
        let end = |bank: Bank, along: f32| {
            let front = course.facing_water(bank, along, FRONTS);
            front.transform_point3(Vec3::new(0.0, QUAY + 8.2, 0.0))
        };
        let ends = [end(Bank::Left, along), end(Bank::Right, along + 3.0)];
        string(modeller, palette, &palette.festoon, ends, 2.6);
    }
}

/// A string that hangs `sag` below its ends in the middle, with bulbs of the colours in turn.
fn string(
    modeller: &mut Modeller,
    palette: &Palette,
    colours: &[MaterialId],
    [a, b]: [Vec3; 2],
    sag: f32,
) {
    let at = |t: f32| a.lerp(b, t) - Vec3::Y * (4.0 * sag * t * (1.0 - t));
    let mut colours = colours.iter().cycle();
    let bulbs = (1u16..).map_while(|k| {
        let t = f32::from(k) * SPACING / a.distance(b);
        (t < 1.0).then_some(t)
    });
    let mut before = a;
    for t in bulbs {
        let point = at(t);
        modeller.bar(palette.iron, [before, point], [0.008, 0.008], 3);
        before = point;
        if let Some(&colour) = colours.next() {
            modeller.octahedron(colour, point - Vec3::Y * 0.07, BULB);
        }
    }
    modeller.bar(palette.iron, [before, b], [0.008, 0.008], 3);
}
