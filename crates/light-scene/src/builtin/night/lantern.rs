use super::course::{Bank, Course};
use super::measures::{BRIDGES, QUAY, WATER};
use super::palette::Palette;
use crate::builtin::modeller::Modeller;
use crate::glam::{Affine3A, Vec3};

/// From one lantern to the next along a quay, in metres.
pub(super) const SPACING: f32 = 9.0;

/// Distance of a lantern's post behind the quay wall, in metres.
const BEHIND_WALL: f32 = 0.9;

/// Height of a lantern's glass above its foot.
pub(super) const GLASS: f32 = 3.1;

/// The positions of the lanterns of one bank, along the middle of the canal; none where a bridge
/// comes ashore.
pub(super) fn places(course: &Course, bank: Bank) -> Vec<f32> {
    let along = |k: u8| course.along(bank, WATER, f32::from(k) * SPACING - 8.0);
    let free = |at: &f32| BRIDGES.iter().all(|bridge| (at - bridge).abs() > 4.2);
    (0..15).map(along).filter(free).collect()
}

/// The foot of a lantern's post.
pub(super) fn foot(course: &Course, bank: Bank, along: f32) -> Vec3 {
    let transform = course.facing_water(bank, along, WATER + BEHIND_WALL);
    Vec3::from(transform.translation) + Vec3::Y * QUAY
}

/// The lanterns of one bank.
pub(super) fn row(modeller: &mut Modeller, palette: &Palette, course: &Course, bank: Bank) {
    for along in places(course, bank) {
        let mut transform = course.facing_water(bank, along, WATER + BEHIND_WALL);
        transform.translation.y += QUAY;
        lantern(modeller, palette, &transform, GLASS);
    }
}

/// A lantern whose glass begins `height` above the origin of `transform`: post, four panes, roof.
pub(super) fn lantern(
    modeller: &mut Modeller,
    palette: &Palette,
    transform: &Affine3A,
    height: f32,
) {
    let at = |y: f32| transform.transform_point3(Vec3::Y * y);
    modeller.bar(palette.iron, [at(0.0), at(0.5)], [0.13, 0.09], 8);
    modeller.bar(palette.iron, [at(0.5), at(height)], [0.06, 0.045], 8);
    let base = Vec3::new(0.16, 0.05, 0.16);
    let floor = Vec3::Y * height;
    modeller.block(palette.iron, transform, floor - base, floor + base);
    // The glass widens upward, as the old lanterns do.
    let (bottom, top, y0, y1) = (0.13, 0.21, height + 0.05, height + 0.5);
    let corner = |x: f32, z: f32, half: f32, y: f32| {
        transform.transform_point3(Vec3::new(x * half, y, z * half))
    };
    let around = [
        (-1.0, 1.0),
        (1.0, 1.0),
        (1.0, -1.0),
        (-1.0, -1.0),
        (-1.0, 1.0),
    ];
    for edge in around.windows(2) {
        let ((ax, az), (bx, bz)) = (edge[0], edge[1]);
        let pane = [
            corner(ax, az, bottom, y0),
            corner(bx, bz, bottom, y0),
            corner(bx, bz, top, y1),
            corner(ax, az, top, y1),
        ];
        modeller.quad(palette.lantern, pane);
        let roof = [
            corner(ax, az, 0.27, y1),
            corner(bx, bz, 0.27, y1),
            at(y1 + 0.3),
        ];
        modeller.triangle(palette.iron, roof);
        let eave = [corner(bx, bz, 0.27, y1), corner(ax, az, 0.27, y1), at(y1)];
        modeller.triangle(palette.iron, eave);
    }
}
