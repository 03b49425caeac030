use lights::math::Aabb;
use lights::math::spectrum::cie;
use lights::media::{
    AnyMedium, ColorGrid, ColorGridMedium, DensityGrid, Glow, Grid, GridError, GridMedium,
    TemperatureGrid,
};
use lights::sources::Rgb;

use super::cloud::Cloud;
use super::file_loc::Typed;
use super::media::{phase, refused, substance};
use super::parameter::ParameterType::{self, Float, Rgb as Colors};
use super::state::Reader;
use crate::Diagnostic;
use crate::glam::Vec3;

/// The red, green and blue channel of a colour.
const RGB: [Vec3; 3] = [Vec3::X, Vec3::Y, Vec3::Z];

impl Reader {
    /// A medium of type "uniformgrid".
    pub(super) fn uniform_grid(&mut self, typed: &Typed<'_>) -> Result<AnyMedium<Rgb>, Diagnostic> {
        let parameters = &typed.parameters;
        let size = size(typed)?;
        let density = values(typed, "density", size, Float)?
            .ok_or_else(|| refused(typed, "expected values of `density`"))?;
        let density = DensityGrid::new(size, density);
        let density = density.map_err(|error| bad_values(typed, "density", error))?;

        let mut glow = Glow::uniform();
        if let Some(scale) = values(typed, "Lescale", size, Float)? {
            let grid = Grid::new(size, scale);
            glow.scale = Some(grid.map_err(|error| bad_values(typed, "Lescale", error))?);
        }
        // The second name is the older one.
        let offset = parameters.number_or("temperaturecutoff", 0.0);
        let offset = parameters.number_or("temperatureoffset", offset);
        let scale = parameters.number_or("temperaturescale", 1.0);
        let mut le = self.glow(typed);
        if let Some(mut kelvin) = values(typed, "temperature", size, Float)? {
            if le != Vec3::ZERO {
                return Err(refused(typed, "expected `Le` or `temperature`, found both"));
            }
            for k in &mut kelvin {
                *k = ((*k - offset) * scale).max(0.0);
            }
            let grid = Grid::new(size, kelvin);
            let grid = grid.map_err(|error| bad_values(typed, "temperature", error))?;
            glow.temperature = Some(TemperatureGrid::new(grid));
            // pbrt takes a radiance of 1 at one wavelength for what it is, where a light's is
            // scaled to a luminance.
            le = Vec3::splat(cie::Y_INTEGRAL);
        }

        let sigma_a = self.coefficient(typed, "sigma_a", Vec3::ONE);
        let sigma_s = self.coefficient(typed, "sigma_s", Vec3::ONE);
        let scale = parameters.amount_or("scale", 1.0);
        let substance = substance(typed, [sigma_a, sigma_s], scale, le)?;
        let transform = self.medium_to_scene();
        let medium = GridMedium::new(
            substance,
            phase(typed)?,
            bounds(typed),
            transform,
            density,
            glow,
        );
        Ok(medium.map_err(|error| refused(typed, error))?.into())
    }

    /// A medium of type "rgbgrid".
    pub(super) fn rgb_grid(&mut self, typed: &Typed<'_>) -> Result<AnyMedium<Rgb>, Diagnostic> {
        let size = size(typed)?;
        let scale = typed.parameters.amount_or("scale", 1.0);
        let le_scale = typed.parameters.amount_or("Lescale", 1.0);
        let grid = |name, scale: f32| -> Result<Option<ColorGrid<Rgb, Vec<f32>>>, Diagnostic> {
            let Some(values) = values(typed, name, size, Colors)? else {
                return Ok(None);
            };
            let grid = Grid::new(size, values).map_err(|error| bad_values(typed, name, error))?;
            let colored = ColorGrid::new(RGB.map(|channel| channel * scale), grid);
            colored.map(Some).map_err(|error| refused(typed, error))
        };
        let sigmas = [grid("sigma_a", scale)?, grid("sigma_s", scale)?];
        if sigmas.iter().all(Option::is_none) {
            let message = "expected values of `sigma_a`, of `sigma_s`, or of both";
            return Err(refused(typed, message));
        }
        // A missing grid is 1 everywhere, not scaled.
        let ones = || {
            let grid = Grid::new(size, vec![1.0; 3 * samples(size)]);
            ColorGrid::new(RGB, grid.expect("ones")).expect("colours")
        };
        let [sigma_a, sigma_s] = sigmas.map(|grid| grid.unwrap_or_else(ones));
        let le = grid("Le", le_scale)?;
        let transform = self.medium_to_scene();
        let medium = ColorGridMedium::new(
            sigma_a,
            sigma_s,
            le,
            phase(typed)?,
            bounds(typed),
            transform,
        );
        Ok(medium.map_err(|error| refused(typed, error))?.into())
    }

    /// A medium of type "cloud": a cloud of the same kind, but of another noise, sampled into a
    /// grid.
    pub(super) fn cloud(&mut self, typed: &Typed<'_>) -> Result<AnyMedium<Rgb>, Diagnostic> {
        const SIZE: [u32; 3] = [64; 3];
        self.warn(
            typed.at,
            "a medium of type \"cloud\"",
            "has another noise here, and details of a 64th of its box",
        );
        let parameters = &typed.parameters;
        let cloud = Cloud {
            density: parameters.number_or("density", 1.0),
            wispiness: parameters.number_or("wispiness", 1.0),
            frequency: parameters.number_or("frequency", 5.0),
        };
        let bounds = bounds(typed);
        let density = DensityGrid::new(SIZE, cloud.sampled(&bounds, SIZE));
        let density = density.map_err(|error| bad_values(typed, "density", error))?;
        let sigma_a = self.coefficient(typed, "sigma_a", Vec3::ONE);
        let sigma_s = self.coefficient(typed, "sigma_s", Vec3::ONE);
        let substance = substance(typed, [sigma_a, sigma_s], 1.0, Vec3::ZERO)?;
        let (transform, glow) = (self.medium_to_scene(), Glow::uniform());
        let medium = GridMedium::new(substance, phase(typed)?, bounds, transform, density, glow);
        Ok(medium.map_err(|error| refused(typed, error))?.into())
    }
}

/// The box of a medium.
fn bounds(typed: &Typed<'_>) -> Aabb {
    let p0 = typed.parameters.vec3_or("p0", Vec3::ZERO);
    let p1 = typed.parameters.vec3_or("p1", Vec3::ONE);
    Aabb::new(p0.min(p1), p0.max(p1))
}

/// Samples on each axis.
fn size(typed: &Typed<'_>) -> Result<[u32; 3], Diagnostic> {
    /// The largest number of samples per axis.
    const MOST: u32 = 1 << 16;
    let mut size = [1; 3];
    for (n, name) in size.iter_mut().zip(["nx", "ny", "nz"]) {
        *n = typed.parameters.count(name, MOST).unwrap_or(1);
    }
    // Before the numbers of values are compared.
    typed.parameters.check()?;
    Ok(size)
}

fn samples(size: [u32; 3]) -> usize {
    size.iter().map(|&n| n as usize).product()
}

/// The values of a grid, if the file has any.
fn values(
    typed: &Typed<'_>,
    name: &str,
    size: [u32; 3],
    kind: ParameterType,
) -> Result<Option<Vec<f32>>, Diagnostic> {
    let Some(values) = typed.parameters.list(name, kind) else {
        return Ok(None);
    };
    let channels = if kind == Colors { 3 } else { 1 };
    let expected = channels * samples(size);
    if values.len() == expected {
        return Ok(Some(values));
    }
    let [nx, ny, nz] = size;
    let message = format!(
        "expected {expected} values of `{name}` for a grid of {nx} x {ny} x {nz}, found {}",
        values.len()
    );
    Err(refused(typed, message))
}

fn bad_values(typed: &Typed<'_>, name: &str, error: GridError) -> Diagnostic {
    refused(typed, format!("`{name}`: {error}"))
}
