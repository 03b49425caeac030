use core::str::FromStr;

use light_sets::SetLight;
use lights::glam::DVec3;

/// What counts as the contribution of a light at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GroundTruth {
    /// All of the light at its position; of a triangle at its centroid.
    #[default]
    Centroid,
    /// The mean over 16 points of each triangle.
    Area,
}

impl GroundTruth {
    /// The points of `light` that its contribution is the mean over.
    pub(super) fn points(self, light: &SetLight) -> impl ExactSizeIterator<Item = DVec3> {
        let barycentric = match (self, light) {
            (Self::Area, SetLight::Triangle { .. }) => &SIXTEEN[..],
            _ => &[(1.0 / 3.0, 1.0 / 3.0)],
        };
        barycentric.iter().map(|&(s, t)| light.point(s, t))
    }
}

impl FromStr for GroundTruth {
    type Err = &'static str;

    fn from_str(s: &str) -> Result<Self, Self::Err> {
        match s {
            "centroid" => Ok(Self::Centroid),
            "area" => Ok(Self::Area),
            _ => Err("expected centroid or area"),
        }
    }
}

/// Centroids of the 16 triangles that two halvings of each edge make.
const SIXTEEN: [(f64, f64); 16] = {
    let mut out = [(0.0, 0.0); 16];
    let mut next = 0;
    let mut i = 0;
    while i < 4 {
        let mut j = 0;
        while i + j < 4 {
            out[next] = ((i as f64 + 1.0 / 3.0) / 4.0, (j as f64 + 1.0 / 3.0) / 4.0);
            next += 1;
            if i + j < 3 {
                out[next] = ((i as f64 + 2.0 / 3.0) / 4.0, (j as f64 + 2.0 / 3.0) / 4.0);
                next += 1;
            }
            j += 1;
        }
        i += 1;
    }
    out
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sixteen_points_are_centred_and_inside() {
        let (s, t) = SIXTEEN
            .iter()
            .fold((0.0, 0.0), |(a, b), &(s, t)| (a + s / 16.0, b + t / 16.0));
        assert!((s - 1.0 / 3.0).abs() < 1e-12, "mean of the first");
        assert!((t - 1.0 / 3.0).abs() < 1e-12, "mean of the second");
        assert!(
            SIXTEEN
                .iter()
                .all(|&(s, t)| s > 0.0 && t > 0.0 && s + t < 1.0),
            "inside"
        );
    }

    #[test]
    fn far_away_both_ground_truths_agree() {
        let set = light_sets::BenchSet::generate(light_sets::SetKind::Clusters, 20, 1);
        let mut at = set.points[0];
        at.p.z -= 1000.0;
        for light in &set.lights {
            let [a, b] = [GroundTruth::Centroid, GroundTruth::Area].map(|ground_truth| {
                let n = at.n.as_dvec3();
                let from = |p| light.contribution_from(p, at.p, 0.0, |wi| n.dot(wi).max(0.0));
                let points = ground_truth.points(light);
                let count = points.len() as f64;
                points.map(from).sum::<f64>() / count
            });
            assert!((a - b).abs() <= 1e-3 * a.max(b), "{a} against {b}");
        }
    }
}
