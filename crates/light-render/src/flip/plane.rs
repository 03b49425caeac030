use rayon::prelude::*;

/// One channel of a picture, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plane {
    width: usize,
    values: Vec<f32>,
}

/// Weights of pixels from `-radius` to `radius`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Kernel {
    weights: Vec<f32>,
}

impl Kernel {
    /// The weight of each distance from `-radius` to `radius`, as it is.
    pub(super) fn new(radius: usize, weight: impl Fn(f32) -> f32) -> Self {
        let distances = (0..=2 * radius).map(|i| i as f32 - radius as f32);
        Self {
            weights: distances.map(weight).collect(),
        }
    }

    /// With positive weights that add up to 1, and negative ones to -1.
    pub(super) fn normalized(self) -> Self {
        let sum = |sign: f32| -> f32 { self.weights.iter().map(|w| (sign * w).max(0.0)).sum() };
        let (positive, negative) = (sum(1.0), sum(-1.0));
        let scale = |&w: &f32| {
            w / if w > 0.0 {
                positive
            } else {
                negative.max(f32::MIN_POSITIVE)
            }
        };
        Self {
            weights: self.weights.iter().map(scale).collect(),
        }
    }

    /// The sum of the weights.
    pub(super) fn sum(&self) -> f32 {
        self.weights.iter().sum()
    }

    const fn radius(&self) -> usize {
        self.weights.len() / 2
    }

    /// The weights, each with the place `at` plus its distance, clamped to `0..len`.
    fn around(&self, at: usize, len: usize) -> impl Iterator<Item = (usize, f32)> {
        let radius = self.radius();
        let places = (0..).map(move |i: usize| (at + i).saturating_sub(radius).min(len - 1));
        places.zip(self.weights.iter().copied())
    }
}

impl Plane {
    /// The channel of whole rows of `width` pixels.
    pub(super) const fn new(width: usize, values: Vec<f32>) -> Self {
        Self { width, values }
    }

    pub(super) fn values(&self) -> &[f32] {
        &self.values
    }

    /// Each value turned into another.
    pub(super) fn map(mut self, f: impl Fn(f32) -> f32) -> Self {
        self.values.iter_mut().for_each(|value| *value = f(*value));
        self
    }

    /// The sums over neighbours in each row; pixels at the border stand for those beyond it.
    pub(super) fn along_rows(&self, kernel: &Kernel) -> Self {
        let mut values = vec![0.0; self.values.len()];
        let rows = values.par_chunks_mut(self.width);
        rows.zip(self.values.par_chunks(self.width))
            .for_each(|(to, from)| {
                for (x, value) in to.iter_mut().enumerate() {
                    let near = kernel.around(x, self.width);
                    *value = near.map(|(x, weight)| weight * from[x]).sum();
                }
            });
        Self::new(self.width, values)
    }

    /// The sums over neighbours in each column, times `factor`.
    pub(super) fn along_columns(&self, kernel: &Kernel, factor: f32) -> Self {
        let height = self.values.len() / self.width;
        let mut values = vec![0.0; self.values.len()];
        let rows = values.par_chunks_mut(self.width).enumerate();
        rows.for_each(|(y, to)| {
            for (y, weight) in kernel.around(y, height) {
                let from = &self.values[y * self.width..(y + 1) * self.width];
                for (value, x) in to.iter_mut().zip(from) {
                    *value += factor * weight * x;
                }
            }
        });
        Self::new(self.width, values)
    }

    /// The sum of two channels of one picture.
    pub(super) fn plus(mut self, other: &Self) -> Self {
        for (value, more) in self.values.iter_mut().zip(&other.values) {
            *value += more;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_are_repeated() {
        let plane = Plane::new(3, vec![1.0, 2.0, 4.0, 0.0, 0.0, 8.0]);
        let left = Kernel::new(1, |x| if x < 0.0 { 1.0 } else { 0.0 });
        let moved = plane.along_rows(&left);
        assert_eq!(
            moved.values(),
            [1.0, 1.0, 2.0, 0.0, 0.0, 0.0],
            "to the right"
        );
        let moved = plane.along_columns(&left, 2.0);
        assert_eq!(
            moved.values(),
            [2.0, 4.0, 8.0, 2.0, 4.0, 8.0],
            "down, twice"
        );
    }

    #[test]
    fn kernels_are_normalized_by_sign() {
        let kernel = Kernel::new(2, |x| -x).normalized();
        let expected = [2.0 / 3.0, 1.0 / 3.0, 0.0, -1.0 / 3.0, -2.0 / 3.0];
        let error = kernel
            .weights
            .iter()
            .zip(expected)
            .map(|(a, b)| (a - b).abs());
        assert!(error.fold(0.0, f32::max) < 1e-6, "{kernel:?}");
    }
}
