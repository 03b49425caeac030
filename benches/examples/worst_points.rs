//! Where the variance of one choice is worst: the points of a generated set with the largest V, and
//! on the way down to the light that has most of it, what each node knows of its children.
//!
//! ```sh
//! cargo run --release -p benches --example worst_points -- nested 100 2 [POINTS [WORST]]
//! ```

use std::error::Error;

use benches::exact_variance::flat_variance;
use light_sets::{BenchSet, SetKind, SetPoint};
use lights::bvh::light_bounds::LightSampleContext;
use lights::bvh::{LightBvh, WideNode};
use lights::glam::Vec3;

/// A point, its V, and for each light what it gives.
struct Measured {
    point: SetPoint,
    variance: f64,
    given: Vec<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, lights, seed, rest @ ..] = arguments.as_slice() else {
        return Err("expected SET LIGHTS SEED [POINTS [WORST]]".into());
    };
    let number = |at: usize, default| rest.get(at).map_or(Ok(default), |n| n.parse::<usize>());
    let (points, worst) = (number(0, 1024)?, number(1, 3)?);
    let kind: SetKind = kind.parse()?;
    let set = BenchSet::generate(kind, lights.parse()?, seed.parse()?);
    let tree = LightBvh::build(&set.extents())?;
    let measured = set.points.iter().take(points);
    let mut measured: Vec<_> = measured.filter_map(|&p| measure(&set, &tree, p)).collect();
    measured.sort_by(|a, b| b.variance.total_cmp(&a.variance));
    let brightest = measured.iter().map(Measured::total).fold(0.0, f64::max);
    for point in measured.iter().take(worst) {
        println!(
            "V {:.3e} at {} facing {}, light {:.1e} of the brightest point's",
            point.variance,
            point.point.p,
            point.point.n,
            point.total() / brightest
        );
        show_way(&tree, point);
    }
    Ok(())
}

impl Measured {
    fn total(&self) -> f64 {
        self.given.iter().sum()
    }
}

fn measure(set: &BenchSet, tree: &LightBvh, point: SetPoint) -> Option<Measured> {
    let variance = flat_variance(&set.lights, tree, &point)?;
    let lights = set.lights.iter();
    Some(Measured {
        point,
        variance,
        given: lights.map(|light| light.contribution(&point)).collect(),
    })
}

/// The nodes from the root to the light with the largest part in V.
fn show_way(tree: &LightBvh, point: &Measured) {
    let (view, total) = (tree.view(), point.total());
    let SetPoint { p, n } = point.point;
    let mut pmfs = vec![0.0; point.given.len()];
    view.for_each_pmf(&LightSampleContext::surface(p, n, n), |light, pmf| {
        pmfs[light.index()] = f64::from(pmf);
    });
    // What a light adds to the second moment, of one choice over the light of the point.
    let moment = |light: usize| {
        let share = point.given[light] / total;
        if share > 0.0 {
            share * share / pmfs[light]
        } else {
            0.0
        }
    };
    let lights = 0..point.given.len();
    let Some(light) = lights.max_by(|&a, &b| moment(a).total_cmp(&moment(b))) else {
        return;
    };
    println!(
        "  light {light}, {:.2} of it",
        moment(light) / point.variance
    );
    let mut way = vec![view.slots()[light]];
    loop {
        let parent = view.nodes()[way[way.len() - 1] as usize / 16].parent;
        if parent == u32::MAX {
            break;
        }
        way.push(parent);
    }
    for slot in way.into_iter().rev() {
        let (index, on_way) = (slot as usize / 16, slot as usize % 16);
        let node = &view.nodes()[index];
        let at = (p - Vec3::from(node.origin)) * node.inv_scale;
        println!(
            "  node {index}, a code {:.2e}, the point at codes {at:.1}",
            1.0 / node.inv_scale
        );
        for child in 0..node.children() {
            let lights = lights_below(tree, node, child);
            let sum = |of: &[f64]| lights.iter().map(|&light| of[light]).sum::<f64>();
            let (given, pmf) = (sum(&point.given) / total, sum(&pmfs));
            let codes = |codes: &[[u8; 16]; 3]| codes.map(|of_axis| of_axis[child]);
            println!(
                "    {} {child:2}: {:5} lights, gives {given:.2e}, chosen {pmf:.2e}, mean {:?}, \
                 extent {:?}, power {}",
                if child == on_way { '>' } else { ' ' },
                lights.len(),
                codes(&node.mean),
                codes(&node.extent),
                node.power[child],
            );
        }
    }
}

/// The lights of a child of a node.
fn lights_below(tree: &LightBvh, node: &WideNode, child: usize) -> Vec<usize> {
    let (view, inner) = (tree.view(), usize::from(node.inner));
    if child >= inner {
        return vec![view.order()[node.light_base as usize + child - inner] as usize];
    }
    let below = &view.nodes()[node.child_base as usize + child];
    let children = 0..below.children();
    children
        .flat_map(|child| lights_below(tree, below, child))
        .collect()
}
