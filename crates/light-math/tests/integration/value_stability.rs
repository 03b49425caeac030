//! Warps, maps and tables give the bits that they gave before, with software float functions on
//! every target.
//!
//! A change that moves them is *value-breaking* and says so in the changelog. The new table is what
//! the failed test prints: `cargo test -p light-math --features libm --test integration
//! value_stability::`.

use light_math::distribution::{
    AliasTable, PiecewiseConstant1D, PiecewiseConstant2D, SummedAreaTable, Window,
    WindowedPiecewiseConstant2D,
};
use light_math::glam::{Vec2, Vec3};
use light_math::{OctahedralVector, discrete, equal_area, fraction, lat_long, warp};
use light_testkit::{Fingerprint, assert_pinned};

/// What each function gives at [`places`], as a fingerprint of all bits.
const PINNED: &[(&str, u64)] = &[
    ("bilinear", 0x9fc4bbca13ef10dc),
    ("concentric_disk", 0xd9b923c75bb180ba),
    ("cosine_hemisphere", 0xfcf5f2e22ffaa9b5),
    ("equiangular", 0x2239648d55f7f65f),
    ("linear", 0xf59e5a55efcc32c9),
    ("polar_disk", 0x0ab0bc3e2b761d8a),
    ("smoothstep", 0x7f41b7168b129ba1),
    ("spherical_rectangle", 0x69f826063fc442ea),
    ("spherical_triangle", 0xdbf6d96e1e61c9ad),
    ("uniform_cone", 0x7287871738d1cd2f),
    ("uniform_hemisphere", 0xa4f9a7148c752c33),
    ("uniform_sphere", 0xc8bf1885aa786598),
    ("uniform_triangle", 0xcf6a5922de4914d2),
    ("octahedral", 0xcc7ac83b76bd93c1),
    ("square_to_sphere", 0xe8e63e3a1b8a60d2),
    ("sphere_to_square", 0xc5f1c35068860fd7),
    ("lat_long_direction", 0x5ace777e9572669f),
    ("lat_long_uv", 0x512603cd38167d6d),
    ("alias_table", 0x6f1a073fa268595d),
    ("discrete", 0x753e63a093fe39cb),
    ("piecewise_constant_1d", 0x06f1bdd4116fff9d),
    ("piecewise_constant_2d", 0x01d807bb14fe5be6),
    ("windowed_piecewise_constant_2d", 0x63147ee84333e8dd),
];

/// What is hashed: its numbers in order.
trait Numbers {
    fn each(&self, add: impl FnMut(f32));
}

impl Numbers for f32 {
    fn each(&self, mut add: impl FnMut(Self)) {
        add(*self);
    }
}

impl Numbers for Vec2 {
    fn each(&self, add: impl FnMut(f32)) {
        self.to_array().into_iter().for_each(add);
    }
}

impl Numbers for Vec3 {
    fn each(&self, add: impl FnMut(f32)) {
        self.to_array().into_iter().for_each(add);
    }
}

/// A grid of the unit square that meets its lower edges and comes near its upper ones.
fn places() -> impl Iterator<Item = Vec2> {
    let last = 1.0 - f32::EPSILON / 2.0;
    let coordinate = move |i: u8| (f32::from(i) / 16.0).min(last);
    (0..=16u8).flat_map(move |y| (0..=16u8).map(move |x| Vec2::new(coordinate(x), coordinate(y))))
}

fn of<T: Numbers>(f: impl Fn(Vec2) -> T) -> u64 {
    let mut fingerprint = Fingerprint::default();
    for u in places() {
        f(u).each(|number| fingerprint.add([number]));
    }
    fingerprint.value()
}

const WEIGHTS: [f32; 12] = [
    3.0, 0.0, 1.0, 4.0, 1.5, 9.0, 2.0, 6.0, 0.25, 3.5, 8.0, 0.125,
];

fn warps() -> Vec<(&'static str, u64)> {
    let corners = [1.0, 0.2, 3.0, 0.5];
    let p = Vec3::new(0.1, -0.2, 0.3);
    let [a, b, c] = [
        Vec3::new(1.0, 0.2, 2.0),
        Vec3::new(0.3, 1.5, 1.0),
        Vec3::new(-0.7, 0.1, 1.4),
    ];
    let triangle = warp::SphericalTriangle::new([a, b, c], p).expect("a triangle");
    let rectangle = warp::SphericalRectangle::new(a, Vec3::X * 2.0, Vec3::Y, p).expect("one");
    let equiangular = warp::Equiangular::new(a, Vec3::X, 0.5, 7.0).expect("a ray");
    vec![
        ("bilinear", of(|u| warp::bilinear::sample(u, corners))),
        ("concentric_disk", of(warp::concentric_disk::sample)),
        ("cosine_hemisphere", of(warp::cosine_hemisphere::sample)),
        ("equiangular", of(|u| equiangular.sample(u.x))),
        ("linear", of(|u| warp::linear::sample(u.x, 0.3, 2.0 * u.y))),
        ("polar_disk", of(warp::polar_disk::sample)),
        (
            "smoothstep",
            of(|u| warp::smoothstep::sample(u.x, -1.0, 2.0)),
        ),
        ("spherical_rectangle", of(|u| rectangle.sample(u))),
        ("spherical_triangle", of(|u| triangle.sample(u))),
        ("uniform_cone", of(|u| warp::uniform_cone::sample(u, 0.3))),
        ("uniform_hemisphere", of(warp::uniform_hemisphere::sample)),
        ("uniform_sphere", of(warp::uniform_sphere::sample)),
        ("uniform_triangle", of(warp::uniform_triangle::sample)),
    ]
}

fn maps() -> Vec<(&'static str, u64)> {
    let octahedral = |u: Vec2| OctahedralVector::encode(warp::uniform_sphere::sample(u)).decode();
    let inverse = |u: Vec2| equal_area::sphere_to_square(warp::uniform_sphere::sample(u));
    vec![
        ("octahedral", of(octahedral)),
        ("square_to_sphere", of(equal_area::square_to_sphere)),
        ("sphere_to_square", of(inverse)),
        ("lat_long_direction", of(lat_long::direction)),
        (
            "lat_long_uv",
            of(|u| lat_long::uv(warp::uniform_sphere::sample(u))),
        ),
    ]
}

fn tables() -> Vec<(&'static str, u64)> {
    let alias = AliasTable::new(&WEIGHTS).expect("a table");
    let line = PiecewiseConstant1D::new(&WEIGHTS).expect("a table");
    let plane = PiecewiseConstant2D::new(&WEIGHTS, 4, 3).expect("a table");
    let sums = SummedAreaTable::new(&WEIGHTS, 4, 3).expect("a table");
    let windowed = WindowedPiecewiseConstant2D::new(sums);
    let window = Window {
        min: Vec2::new(0.1, 0.2),
        max: Vec2::new(0.8, 0.9),
    };
    let fine = |u: Vec2| f64::from(u.x) + f64::from(u.y) / 1024.0;
    let index = |index: usize, pmf: f32| Vec2::new(index as f32, pmf);
    vec![
        (
            "alias_table",
            of(|u| {
                let sample = alias.sample(fraction::from_f64(fine(u).min(0.999)));
                index(sample.index, sample.pmf)
            }),
        ),
        (
            "discrete",
            of(|u| {
                let sample = discrete::sample(&WEIGHTS, fraction::from_f64(fine(u).min(0.999)))
                    .expect("weights");
                index(sample.index, sample.pmf)
            }),
        ),
        (
            "piecewise_constant_1d",
            of(|u| {
                let sample = line.sample(u.x);
                Vec2::new(sample.x, sample.pdf)
            }),
        ),
        (
            "piecewise_constant_2d",
            of(|u| {
                let sample = plane.sample(u);
                sample.p.extend(sample.pdf)
            }),
        ),
        (
            "windowed_piecewise_constant_2d",
            of(|u| {
                let sample = windowed.sample(u, &window).expect("light in the window");
                sample.p.extend(sample.pdf)
            }),
        ),
    ]
}

#[test]
fn values_are_those_of_before() {
    assert_pinned(&[warps(), maps(), tables()].concat(), PINNED);
}
