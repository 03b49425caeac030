use super::contrast::whole;
use super::plane::{Kernel, Plane};

/// The width of the features that are looked for, in degrees.
const WIDTH: f32 = 0.082;

/// Filters that find edges and points: first and second derivatives of a Gaussian.
///
/// # Source
/// `[Andersson2020]`, section 4.2.
pub(super) struct Derivatives {
    gaussian: Kernel,
    first: Kernel,
    second: Kernel,
}

/// How much of an edge and of a point each pixel is.
pub(super) struct Features {
    edges: Vec<f32>,
    points: Vec<f32>,
}

impl Derivatives {
    pub(super) fn new(pixels_per_degree: f32) -> Self {
        let deviation = 0.5 * WIDTH * pixels_per_degree;
        let radius = whole(3.0 * deviation);
        let square = deviation * deviation;
        let gaussian = |x: f32| (-x * x / (2.0 * square)).exp();
        let kernel = |weight: &dyn Fn(f32) -> f32| Kernel::new(radius, weight).normalized();
        Self {
            gaussian: kernel(&gaussian),
            first: kernel(&|x| -x * gaussian(x)),
            second: kernel(&|x| (x * x / square - 1.0) * gaussian(x)),
        }
    }

    /// The features of a grey picture.
    pub(super) fn features(&self, gray: &Plane) -> Features {
        let smooth = gray.along_rows(&self.gaussian);
        let magnitude = |derivative: &Kernel| -> Vec<f32> {
            let across = gray
                .along_rows(derivative)
                .along_columns(&self.gaussian, 1.0);
            let down = smooth.along_columns(derivative, 1.0);
            let parts = across.values().iter().zip(down.values());
            parts.map(|(x, y)| x.hypot(*y)).collect()
        };
        Features {
            edges: magnitude(&self.first),
            points: magnitude(&self.second),
        }
    }
}

impl Features {
    /// The difference of two pictures in `[0, 1]` at a pixel: that of edges or of points, whichever
    /// is larger.
    pub(super) fn difference(&self, other: &Self, pixel: usize) -> f32 {
        let edges = (self.edges[pixel] - other.edges[pixel]).abs();
        let points = (self.points[pixel] - other.points[pixel]).abs();
        (edges.max(points) * core::f32::consts::FRAC_1_SQRT_2).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_an_edge_and_a_constant_is_nothing() {
        let derivatives = Derivatives::new(67.0);
        let step = (0..40).map(|x| if x < 20 { 0.0 } else { 1.0 }).collect();
        let step = derivatives.features(&Plane::new(40, step));
        let flat = derivatives.features(&Plane::new(40, vec![0.7; 40]));
        assert!(step.edges[20] > 0.9 && step.edges[0] < 1e-6, "at the step");
        assert!(
            flat.edges.iter().chain(&flat.points).all(|x| *x < 1e-6),
            "none"
        );
        let there = step.difference(&flat, 20);
        assert!(there > 0.8 && there <= 1.0, "{there}");
    }
}
