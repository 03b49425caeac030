use super::*;

/// The triangles' areas: all, and those that run the wrong way around.
fn areas(corners: &[Vec3], n: Vec3) -> [f32; 2] {
    let list = triangles(corners).expect("not too involved");
    assert_eq!(list.len(), corners.len() - 2, "as many as ever");
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| corners[i as usize]);
        0.5 * (b - a).cross(c - a).dot(n)
    };
    let areas: Vec<f32> = list.iter().map(area).collect();
    let wrong = areas.iter().filter(|&&area| area < 0.0).map(|area| -area);
    [areas.iter().sum(), wrong.sum()]
}

fn circle(count: u16, radius: impl Fn(u16) -> f32) -> Vec<Vec3> {
    let angle = |i: u16| f32::from(i) / f32::from(count) * core::f32::consts::TAU;
    let corner = |i: u16| {
        let (sin, cos) = angle(i).sin_cos();
        Vec3::new(cos, 0.0, -sin) * radius(i)
    };
    (0..count).map(corner).collect()
}

#[test]
fn small_convex_faces_are_fans() {
    let square = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
    assert_eq!(triangles(&square), Ok(vec![[0, 1, 2], [0, 2, 3]]), "a fan");
    let fan: Vec<[u32; 3]> = (1..15).map(|i| [0, i, i + 1]).collect();
    assert_eq!(triangles(&circle(16, |_| 1.0)), Ok(fan), "a fan");
    assert_eq!(triangles(&square[..3]), Ok(vec![[0, 1, 2]]), "itself");
}

/// A fan would put a third of the arrow's area outside of it.
#[test]
fn faces_that_are_not_convex_are_covered_and_nothing_else() {
    let arrow = [(0.0, 0.0), (2.0, 2.0), (0.0, 1.0), (-2.0, 2.0)];
    let arrow = arrow.map(|(x, z)| Vec3::new(x, 3.0, -z));
    for turned in 0..4 {
        let mut arrow = arrow;
        arrow.rotate_left(turned);
        assert_eq!(areas(&arrow, Vec3::Y), [2.0, 0.0], "{turned}");
    }
    let spikes = circle(300, |i| if i % 2 == 0 { 1.0 } else { 0.25 });
    let [found, wrong] = areas(&spikes, Vec3::Y);
    let between = (core::f32::consts::TAU / 300.0).sin();
    let expected = 150.0 * between * 0.25;
    assert!(
        (found / expected - 1.0).abs() < 1e-4 && wrong < 1e-6,
        "{found}"
    );
    // A square with a square hole, along a cut from the outer to the inner rim.
    let hole = [
        (0.0, 0.0),
        (3.0, 0.0),
        (3.0, 3.0),
        (0.0, 3.0),
        (0.0, 0.0),
        (1.0, 1.0),
        (1.0, 2.0),
        (2.0, 2.0),
        (2.0, 1.0),
        (1.0, 1.0),
    ];
    let hole = hole.map(|(x, y)| Vec3::new(x, y, 0.0));
    assert_eq!(areas(&hole, Vec3::Z), [8.0, 0.0], "a hole");
}

/// Counts how many triangles meet in a corner: a fan has all of them in one.
#[test]
fn many_corners_make_no_fan() {
    let rim = circle(32_000, |_| 1.0);
    let list = triangles(&rim).expect("convex");
    let mut uses = vec![0u32; rim.len()];
    list.iter().flatten().for_each(|&i| uses[i as usize] += 1);
    let most = uses.iter().max();
    assert!(most < Some(&40), "{most:?} triangles in a corner");
    let [found, _] = areas(&rim, Vec3::Y);
    assert!(
        (found / core::f32::consts::PI - 1.0).abs() < 1e-4,
        "{found}"
    );
}

#[test]
fn too_many_inward_corners_are_refused() {
    let spikes = circle(8_000, |i| if i % 2 == 0 { 1.0 } else { 0.25 });
    let (corners, inward) = (8_000, 4_000);
    let refused = Err(TooInvolved { corners, inward });
    assert_eq!(triangles(&spikes), refused, "32 million");
}

#[test]
fn faces_without_a_plane_still_end() {
    let bow = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
    for corners in [bow.map(|(x, y)| Vec3::new(x, y, 0.0)), [Vec3::ONE; 4]] {
        assert_eq!(triangles(&corners).map(|list| list.len()), Ok(2), "two");
    }
    let star = circle(41, |_| 1.0);
    let star: Vec<Vec3> = (0..41).map(|i| star[i * 7 % 41]).collect();
    assert_eq!(
        triangles(&star).map(|list| list.len()),
        Ok(39),
        "crosses itself"
    );
}
