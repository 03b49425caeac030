use serde_json::{Value, json};

use super::reference::ReferenceSource;
use super::sampler_row::SamplerRow;
use super::scene_report::SceneReport;

impl SceneReport {
    /// All numbers of the page.
    pub(crate) fn json(&self) -> Value {
        let (width, height) = self.size;
        json!({
            "scene": self.options.scene,
            "width": width,
            "height": height,
            "seconds": self.options.time.as_secs_f64(),
            "max_depth": self.options.path.max_depth,
            "seed": self.options.seed,
            "threads": self.threads,
            "triangles": self.triangles,
            "quadrics": self.quadrics,
            "lights": self.lights,
            "light_bytes": self.light_bytes,
            "reference": self.reference_json(),
            "samplers": self.rows.iter().map(row_json).collect::<Vec<_>>(),
            "pixels": self.pixels_json(),
            "kinds": self.inventory.iter().map(|kind| json!({
                "kind": kind.kind,
                "count": kind.count,
                "power": kind.power.to_array(),
                "area": kind.area,
            })).collect::<Vec<_>>(),
            "notes": self.options.notes,
        })
    }

    fn reference_json(&self) -> Value {
        match &self.reference.source {
            ReferenceSource::Given(path) => json!({ "file": path.display().to_string() }),
            ReferenceSource::Made {
                sampler,
                samples,
                time,
                ..
            } => json!({
                "sampler": sampler.name(),
                "spp": samples,
                "seconds": time.as_secs_f64(),
                "relmse": self.reference.rel_mse(),
            }),
        }
    }

    fn pixels_json(&self) -> Vec<Value> {
        let pixel = |pixel: &crate::bench::PixelVariance| {
            let names = self.rows.iter().map(|row| row.kind.name().to_owned());
            let v: serde_json::Map<String, Value> = names
                .zip(pixel.splits.iter().map(|split| json!(split.relative())))
                .collect();
            json!({
                "x": pixel.pixel[0],
                "y": pixel.pixel[1],
                "lights": pixel.lights,
                "arriving": pixel.arriving,
                "v": v,
                "v_best": pixel.best.relative(),
            })
        };
        self.pixels.iter().map(pixel).collect()
    }
}

fn row_json(row: &SamplerRow) -> Value {
    let convergence: Vec<Value> = row
        .convergence
        .iter()
        .map(|(seconds, spp, error)| json!({ "seconds": seconds, "spp": spp, "relmse": error }))
        .collect();
    json!({
        "sampler": row.kind.name(),
        "build_ms": row.build_ms,
        "seconds": row.seconds,
        "spp": row.samples,
        "rays": row.rays,
        "rejected": row.rejected,
        "relmse": row.rel_mse,
        "mse": row.comparison.mse,
        "bias": row.comparison.bias.to_array(),
        "bias_se": row.comparison.bias_error.to_array(),
        "flip_ldr": row.flip_ldr,
        "flip_hdr": row.flip.mean(),
        "slope": row.slope,
        "bytes": row.bytes,
        "convergence": convergence,
        "ns_sample": row.choice(|row| row.time.sample),
        "ns_pmf": row.choice(|row| row.time.pmf),
        "v_mean": row.choice(|row| row.variance.mean),
        "v_median": row.choice(|row| row.variance.median),
        "v_p99": row.choice(|row| row.variance.p99),
        "lost_energy": row.choice(|row| row.variance.lost_energy),
        "no_light": row.choice(|row| row.laws.no_light),
    })
}
