use crate::amount::RadianceAmount;
use crate::color::ColorModel;
use crate::glam::{Vec2, Vec3};
use crate::image_infinite_desc::{EnvironmentMap, ImageInfiniteLightDesc, ImageInfiniteLightError};
use crate::rgb_sum::RgbSum;
use crate::rigid_transform::RigidTransform;
use light_math::spectrum::photometric::Lux;

/// Texels are divided until a row has this many parts: the horizon then cuts parts so small that
/// the sum is within 1e-5 of the integral.
const PARTS: u32 = 1024;

impl EnvironmentMap {
    /// The irradiance in W m^-2 of a plane with the unit `normal`, in light space, under the
    /// picture as it is: the integral of radiance times cosine over the hemisphere, within 1e-5.
    #[must_use]
    pub fn irradiance(&self, normal: Vec3) -> Vec3 {
        let (Self::EqualArea(image) | Self::LatLong(image)) = self;
        let map = self.sphere_map();
        let [width, height] = image.size();
        let parts = [width, height].map(|texels| PARTS.div_ceil(texels.max(1)));
        let [columns, rows] = [width * parts[0], height * parts[1]];
        let area = 1.0 / (f64::from(columns) * f64::from(rows));
        let mut sum = RgbSum::default();
        for y in 0..rows {
            for x in 0..columns {
                let middle = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let p = middle / Vec2::new(columns as f32, rows as f32);
                let cos = map.direction(p).dot(normal);
                if cos > 0.0 {
                    let solid_angle = area * f64::from(map.solid_angle_per_area(p));
                    sum.add(
                        image.texel(x / parts[0], y / parts[1]),
                        f64::from(cos) * solid_angle,
                    );
                }
            }
        }
        sum.over(1.0)
    }
}

impl ImageInfiniteLightDesc {
    /// The same sky, as bright as it must be to give open ground with the normal `up`, in the
    /// scene and of any length above 0, an illuminance of `lux`.
    ///
    /// # Errors
    /// When `transform` is not rigid, or no light comes from above the ground.
    pub fn with_illuminance<C: ColorModel>(
        mut self,
        lux: Lux,
        up: Vec3,
    ) -> Result<Self, ImageInfiniteLightError> {
        let up = up.try_normalize().ok_or(ImageInfiniteLightError::Amount)?;
        let transform = RigidTransform::new(self.transform)?;
        let irradiance = self.map.irradiance(transform.inverse_vector(up));
        let scale = lux.0 / C::flux_of_texel(irradiance).luminous;
        if !scale.is_finite() {
            return Err(ImageInfiniteLightError::Amount);
        }
        self.amount = RadianceAmount::Radiometric(scale);
        Ok(self)
    }
}
