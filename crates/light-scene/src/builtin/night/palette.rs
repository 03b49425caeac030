use crate::builtin::modeller::Modeller;
use crate::glam::{Vec2, Vec3};
use crate::{Emission, Material, MaterialId, Surface};

/// What the town is made of, and the colours of its lights.
#[derive(Clone, Debug)]
pub(super) struct Palette {
    pub(super) water: MaterialId,
    pub(super) paving: MaterialId,
    pub(super) quay_wall: MaterialId,
    pub(super) stone: MaterialId,
    pub(super) iron: MaterialId,
    pub(super) bark: MaterialId,
    pub(super) tiles: MaterialId,
    pub(super) paint: MaterialId,
    pub(super) curtain: MaterialId,
    pub(super) dark_glass: MaterialId,
    /// Fronts of the houses: brick and plaster.
    pub(super) fronts: Vec<MaterialId>,
    /// Doors and hulls.
    pub(super) colours: Vec<MaterialId>,
    /// Panes of lit rooms: each room one row, bright, middling and dim.
    pub(super) rooms: Vec<[MaterialId; 3]>,
    /// Shop windows, as rooms.
    pub(super) shops: Vec<[MaterialId; 3]>,
    pub(super) lantern: MaterialId,
    pub(super) bridge_bulb: MaterialId,
    pub(super) tree_bulb: MaterialId,
    /// Bulbs of the festoons, one colour after the other.
    pub(super) festoon: Vec<MaterialId>,
    pub(super) clock: MaterialId,
    pub(super) flood: MaterialId,
}

impl Palette {
    pub(super) fn new(modeller: &mut Modeller) -> Self {
        let mut matte = |name: &str, r: f32, g: f32, b: f32| {
            modeller.material(Material::diffuse(name, Vec3::new(r, g, b)))
        };
        let fronts = vec![
            matte("red brick", 0.30, 0.13, 0.09),
            matte("brown brick", 0.22, 0.13, 0.09),
            matte("dark brick", 0.13, 0.09, 0.08),
            matte("orange brick", 0.40, 0.20, 0.11),
            matte("white plaster", 0.62, 0.59, 0.54),
            matte("yellow plaster", 0.58, 0.47, 0.28),
            matte("grey plaster", 0.36, 0.36, 0.36),
        ];
        let colours = vec![
            matte("green paint", 0.03, 0.10, 0.06),
            matte("red paint", 0.24, 0.04, 0.03),
            matte("blue paint", 0.04, 0.07, 0.17),
            matte("black paint", 0.03, 0.03, 0.03),
        ];
        let paving = matte("paving", 0.24, 0.22, 0.20);
        let quay_wall = matte("quay wall", 0.16, 0.14, 0.12);
        let stone = matte("stone", 0.48, 0.44, 0.38);
        let iron = matte("iron", 0.03, 0.035, 0.035);
        let bark = matte("bark", 0.12, 0.10, 0.08);
        let tiles = matte("tiles", 0.12, 0.06, 0.05);
        let paint = matte("white paint", 0.68, 0.67, 0.62);
        let curtain = matte("curtain", 0.50, 0.40, 0.33);
        // Neither transmits light: what is not reflected is absorbed.
        let mut shiny = |name: &str, eta: f32, alpha: f32| {
            let surface = Surface::Conductor {
                eta: Vec3::splat(eta),
                k: Vec3::ZERO,
                alpha: Vec2::splat(alpha),
            };
            modeller.material(Material::new(name, surface))
        };
        let water = shiny("water", 1.33, 0.13);
        let dark_glass = shiny("dark glass", 1.5, 0.01);
        let mut light = |name: &str, radiance: f32, r: f32, g: f32, b: f32| {
            modeller.material(Material {
                emission: Some(Emission::one_sided(Vec3::new(r, g, b) * radiance)),
                ..Material::diffuse(name, Vec3::splat(0.3))
            })
        };
        let mut room = |name: &str, r: f32, g: f32, b: f32| {
            [2.2, 1.2, 0.5].map(|radiance| light(name, radiance, r, g, b))
        };
        let (candlelit, warm) = (
            room("candlelit room", 1.0, 0.42, 0.10),
            room("warm room", 1.0, 0.55, 0.20),
        );
        // Most rooms are warm.
        let rooms = vec![
            candlelit,
            candlelit,
            warm,
            warm,
            room("room", 1.0, 0.68, 0.36),
            room("bright room", 1.2, 0.95, 0.66),
            room("kitchen", 0.9, 1.0, 0.95),
            room("television", 0.25, 0.45, 1.0),
            room("red room", 1.0, 0.20, 0.10),
        ];
        let shops = vec![
            room("café", 1.5, 0.72, 0.24),
            room("bookshop", 1.5, 1.05, 0.58),
            room("gallery", 1.25, 1.40, 1.35),
            room("flower shop", 1.05, 1.30, 0.62),
        ];
        Self {
            water,
            paving,
            quay_wall,
            stone,
            iron,
            bark,
            tiles,
            paint,
            curtain,
            dark_glass,
            fronts,
            colours,
            rooms,
            shops,
            lantern: light("lantern", 85.0, 1.0, 0.50, 0.13),
            bridge_bulb: light("bridge bulb", 62.0, 1.0, 0.52, 0.10),
            tree_bulb: light("tree bulb", 44.0, 0.42, 0.70, 1.0),
            festoon: vec![
                light("amber bulb", 60.0, 1.0, 0.40, 0.04),
                light("rose bulb", 52.0, 1.0, 0.10, 0.12),
                light("gold bulb", 60.0, 1.0, 0.55, 0.12),
                light("jade bulb", 44.0, 0.08, 1.0, 0.36),
                light("amber bulb", 60.0, 1.0, 0.40, 0.04),
                light("azure bulb", 52.0, 0.08, 0.36, 1.0),
            ],
            clock: light("clock", 1.6, 1.0, 0.80, 0.48),
            flood: light("flood", 44.0, 1.0, 0.60, 0.26),
        }
    }
}
