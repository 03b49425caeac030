//! What is asked.

use light_bvh::glam::Vec3;
use light_bvh::{LightBvh, LightBvhError, LightBvhRef};
use light_ptx_queries::{
    Choices, Chosen, LightRecord, Query, Random, Receiver, pmf, sample, sample_by_cut,
};
use light_sets::BenchSet;

/// A query of a tree, answered in words.
type Answer = fn(&LightBvhRef<'_>, &Query, &mut [u32]);

/// A kernel that asks a tree, and the same on the host.
#[derive(Clone, Copy)]
pub struct Kernel {
    pub name: &'static str,
    /// Words of an answer.
    pub words: usize,
    pub host: Answer,
}

/// A light of a tree.
pub const SAMPLE: Kernel = Kernel {
    name: "light_sample",
    words: size_of::<Chosen>() / 4,
    host: |tree, query, answer| sample(tree, query, cast_mut(answer)),
};

/// All of them.
pub const KERNELS: [Kernel; 3] = [
    SAMPLE,
    Kernel {
        name: "light_pmf",
        words: 1,
        host: |tree, query, answer| pmf(tree, query, cast_mut(answer)),
    },
    Kernel {
        name: "light_sample_by_cut",
        words: size_of::<Choices>() / 4,
        host: |tree, query, answer| sample_by_cut(tree, query, cast_mut(answer)),
    },
];

/// Queries of a tree.
pub struct Work {
    pub queries: Vec<Query>,
}

impl Work {
    /// At the points of a set, a fifth of each kind of receivers, one kind behind the other: a
    /// warp with all of them computes as long as five.
    pub fn new(set: &BenchSet, count: u32) -> Self {
        let mut work = Self::by(set, count, &Receiver::ALL);
        work.queries.sort_by_key(|query| query.kind);
        work
    }

    /// At the points of a set, of each of these kinds of receivers in turn.
    pub fn by(set: &BenchSet, count: u32, kinds: &[Receiver]) -> Self {
        let mut random = Random(1);
        let lights = set.lights.len() as u32;
        let query = |i: u32| {
            let mut point = || &set.points[random.bits() as usize % set.points.len()];
            let (at, other) = (point(), point());
            let kind = kinds[i as usize % kinds.len()];
            let n = match kind {
                Receiver::Segment => other.p - at.p,
                _ => at.n,
            };
            Query::new(kind, at.p, n, lights, &mut random)
        };
        Self {
            queries: (0..count).map(query).collect(),
        }
    }

    /// The same queries, those of near points behind each other, as the pixels of a picture are.
    pub fn in_order_of_places(mut self) -> Self {
        let cell = |query: &Query| query.p.map(|x| (16.0 * x).floor() as i32);
        self.queries.sort_by_key(cell);
        self
    }
}

/// The tree of a set.
pub fn tree(set: &BenchSet) -> Result<LightBvh, LightBvhError> {
    let lights: Vec<_> = set
        .lights
        .iter()
        .map(|light| light.bounds().into())
        .collect();
    LightBvh::build(&lights)
}

/// Octahedral codes.
pub fn codes(count: u32) -> Vec<u32> {
    let mut random = Random(2);
    (0..count).map(|_| random.bits() as u32).collect()
}

/// Lights of all kinds.
pub fn lights() -> Vec<LightRecord> {
    let mut random = Random(3);
    let kinds = (0..LightRecord::KINDS).cycle().take(700);
    kinds
        .map(|kind| LightRecord::random(kind, &mut random))
        .collect()
}

/// Queries about them, of each kind of receiver in turn.
pub fn about_lights(count: u32) -> Vec<Query> {
    let mut random = Random(4);
    let lights = lights().len() as u32;
    let query = |i: u32| {
        let mut vector = || Vec3::new(random.signed(), random.signed(), random.signed());
        let (p, n) = (2.0 * vector(), vector());
        let kind = Receiver::ALL[i as usize % Receiver::ALL.len()];
        Query::new(kind, p, n, lights, &mut random)
    };
    (0..count).map(query).collect()
}

/// Words as the answer that they hold.
fn cast_mut<T: bytemuck::AnyBitPattern + bytemuck::NoUninit>(words: &mut [u32]) -> &mut T {
    &mut bytemuck::cast_slice_mut(words)[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;
    use light_ptx_queries::arrive;
    use light_sets::SetKind;

    /// A comparison of nothing with nothing would hold.
    #[test]
    fn each_kind_of_light_arrives_somewhere() {
        let lights = lights();
        let mut arrived = [0; LightRecord::KINDS as usize];
        for query in about_lights(7000) {
            let light = &lights[query.other as usize];
            let answer = arrive(light, &query);
            let is_sound = answer.pdf >= 0.0 && answer.l.iter().all(|l| l.is_finite());
            assert!(is_sound, "{light:?}: {answer:?}");
            arrived[light.kind as usize % 8] += u32::from(answer.pdf > 0.0);
        }
        assert!(arrived.iter().all(|&n| n > 100), "{arrived:?}");
    }

    #[test]
    fn choices_have_the_probabilities_of_their_queries() {
        let set = BenchSet::generate(SetKind::Uniform, 1000, 1);
        let bvh = tree(&set).expect("a tree");
        let mut chosen_once = 0;
        for mut query in Work::new(&set, 500).queries {
            let (mut chosen, mut choices) = (Chosen::zeroed(), Choices::zeroed());
            sample(&bvh.view(), &query, &mut chosen);
            sample_by_cut(&bvh.view(), &query, &mut choices);
            // Nothing was chosen where nothing can contribute.
            if chosen.pmf == 0.0 || choices.chosen[2].pmf == 0.0 {
                continue;
            }
            chosen_once += 1;
            query.other = chosen.light;
            let mut found = 0.0;
            pmf(&bvh.view(), &query, &mut found);
            assert_eq!(found, chosen.pmf, "{query:?}");
            query.other = choices.chosen[2].light;
            let expected = choices.chosen[2].pmf;
            sample_by_cut(&bvh.view(), &query, &mut choices);
            assert_eq!(choices.other, expected, "{query:?}");
        }
        assert!(chosen_once > 300, "{chosen_once} of 500");
    }
}
