use core::f32::consts::PI;

use super::file_loc::Typed;
use super::state::Reader;
use crate::glam::{Affine3A, Mat3A, Vec3};
use crate::{
    Color, Diagnostic, MaterialId, Mesh, Prototype, Quadric, QuadricFront, QuadricKind,
    QuadricPart, Surface,
};

/// Of tessellated shapes: columns around; a sphere has half as many rows.
const AROUND: u16 = 64;

/// The sphere, disk or cylinder of a directive, whole or in part, in its own space, with its front
/// outside and without a material; `None` for other shapes.
pub(super) fn quadric(typed: &Typed<'_>) -> Result<Option<Quadric>, Diagnostic> {
    let radius = typed.parameters.positive_or("radius", 1.0);
    let (kind, height, v) = match typed.kind.as_str() {
        "sphere" => sphere(typed, radius),
        "disk" => disk(typed, radius),
        "cylinder" => cylinder(typed, radius),
        _ => return Ok(None),
    };
    if !(radius > 0.0) {
        let message = format!("expected a positive radius, found {radius}");
        return Err(typed.at.diagnostic(message));
    }
    let part = QuadricPart {
        turn: typed.parameters.positive_or("phimax", 360.0).min(360.0) / 360.0,
        v,
    };
    let is_whole = part.turn == 1.0 && part.v == [0.0, 1.0];
    let local = Affine3A::from_translation(Vec3::Z * height);
    let local = local * Affine3A::from_scale(Vec3::splat(radius));
    Ok(Some(Quadric {
        part: (!is_whole).then_some(part),
        ..Quadric::new(typed.kind.as_str(), MaterialId(0), kind, local)
    }))
}

impl Reader {
    /// Adds `quadric` of the current space as such, and one that the current transform stretches as
    /// an object in one place. Returns the triangles, in the space of `quadric` and with their front
    /// outside, that have to replace it where it emits as no light does, and where an object holds a
    /// stretched one.
    pub(super) fn add_as_such(&mut self, typed: &Typed<'_>, quadric: Quadric) -> Option<Mesh> {
        if self.is_added(typed, &quadric) {
            return None;
        }
        let what = format!("Shape \"{}\"", typed.kind);
        self.warn(typed.at, &what, "was made of triangles");
        Some(quadric.mesh(AROUND))
    }

    /// Adds `quadric`, if it can be added as such.
    fn is_added(&mut self, typed: &Typed<'_>, quadric: &Quadric) -> bool {
        let mut quadric = quadric.clone();
        if self.turns_quadrics_over() {
            quadric.front = QuadricFront::Inside;
        }
        let transform = Affine3A::from_mat4(self.state.transform);
        let is_empty = quadric.part.is_some_and(|part| !(part.v[0] < part.v[1]));
        if is_empty || !self.is_one_light(typed, &quadric) {
            return false;
        }
        if let Some(mut moved) = quadric.transformed(&transform) {
            moved.material = self.shape_material(typed, || moved.area());
            self.expect_extent(typed, &moved.bounds());
            self.add_quadric(moved);
            return true;
        }
        let place = transform * quadric.transform;
        let is_object = self.state.area_light.is_none() && self.objects.open.is_none();
        if !(is_object && keeps_digits(&place)) {
            return false;
        }
        quadric.transform = Affine3A::IDENTITY;
        quadric.material = self.shape_material(typed, || 0.0);
        let mut prototype = Prototype::new(typed.kind.as_str(), Vec::new());
        prototype.quadrics.push(quadric);
        let bounds = self.add_single_instance(typed.at, prototype, place);
        self.expect_extent(typed, &bounds);
        true
    }

    /// Whether a quadric, if it is emissive, is whole and has uniform emission that is visible where
    /// light samples find it.
    fn is_one_light(&mut self, typed: &Typed<'_>, quadric: &Quadric) -> bool {
        let Some(light) = self.state.area_light else {
            return true;
        };
        if quadric.part.is_some() {
            return false;
        }
        let &Quadric { kind, front, .. } = quadric;
        let material = self.material();
        let surface = &self.scene.material(material).surface;
        let lets_light_pass = matches!(surface, Surface::Interface | Surface::Mix { .. })
            || self.materials.awaits(material);
        // Nothing of a disk is behind another part of it. Of a sphere that no ray meets pbrt takes
        // the near side alone, of other shapes all.
        let is_flat = matches!(kind, QuadricKind::Disk { .. });
        let is_invisible = self.share(typed, "alpha", 1.0) == Color::Constant(Vec3::ZERO);
        let has_near_side_alone = kind == QuadricKind::Sphere && is_invisible;
        let is_outside = !light.two_sided && front == QuadricFront::Outside;
        let is_even = matches!(light.radiance, Color::Constant(_));
        let is_found = is_flat || is_outside || has_near_side_alone;
        is_even && (is_found || !(lets_light_pass || typed.parameters.has("alpha")))
    }

    /// In pbrt a mirroring transform swaps front and back of quadrics that rays meet, but neither of
    /// meshes nor of the points that light samples take.
    pub(super) fn turns_quadrics_over(&self) -> bool {
        self.state.reversed ^ (self.mirrors() && self.state.area_light.is_none())
    }
}

/// Whether rays can be taken to a space and back: its axes, and theirs of the inverse, have lengths.
fn keeps_digits(place: &Affine3A) -> bool {
    let has_lengths = |matrix: Mat3A| {
        let axes = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        axes.map(|axis| axis.length_squared())
            .iter()
            .sum::<f32>()
            .is_finite()
    };
    place.is_finite() && has_lengths(place.matrix3) && has_lengths(place.matrix3.inverse())
}

/// What a shape says: its kind for radius 1, the height of its centre, and where v of the part that
/// is kept starts and ends.
type Described = (QuadricKind, f32, [f32; 2]);

fn sphere(typed: &Typed<'_>, radius: f32) -> Described {
    let z = [("zmin", -radius), ("zmax", radius)].map(|(name, all)| {
        let z = typed.parameters.number_or(name, all) / radius;
        z.clamp(-1.0, 1.0)
    });
    // From the lower pole on.
    let v = [z[0].min(z[1]), z[0].max(z[1])].map(|z| (PI - z.acos()) / PI);
    (QuadricKind::Sphere, 0.0, v)
}

fn disk(typed: &Typed<'_>, radius: f32) -> Described {
    let parameters = &typed.parameters;
    let is_inside = |inner: f32| (0.0..radius).contains(&inner);
    let inner = parameters.number_where("innerradius", is_inside, "from 0 to below `radius`");
    let inner_radius = inner.unwrap_or(0.0) / radius;
    let height = parameters.number_or("height", 0.0);
    (QuadricKind::Disk { inner_radius }, height, [0.0, 1.0])
}

fn cylinder(typed: &Typed<'_>, radius: f32) -> Described {
    let z = [("zmin", -1.0), ("zmax", 1.0)];
    let z = z.map(|(name, default)| typed.parameters.number_or(name, default));
    let [low, high] = [z[0].min(z[1]), z[0].max(z[1])];
    let length = (high - low) / radius;
    let height = low + 0.5 * (high - low);
    (QuadricKind::Cylinder { length }, height, [0.0, 1.0])
}
