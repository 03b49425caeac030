use light_bounds::LightId;
use light_math::float::positive_product;

use crate::importance::receiver::Receiver;
use crate::query::bvh_ref::{Child, LightBvhRef};
use crate::query::into_receiver::{IntoReceiver, Query, QueryFor};
use crate::simd::dispatch;

impl LightBvhRef<'_> {
    /// Calls `each` with every light that [`sample`](Self::sample) for `receiver` may return and
    /// its [`pmf`](Self::pmf), to the bit, in the order of the nodes.
    ///
    /// One pass over the nodes takes linear time, where a pmf of each light takes a logarithm more.
    /// Allocates four bytes a node.
    ///
    /// ```
    /// use light_bvh::LightBvh;
    /// use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
    /// use light_bvh::light_bounds::{LightBounds, LightExtent, LightSampleContext};
    ///
    /// let lamp = |x: f32| LightBounds {
    ///     bounds: Aabb::from_point(Vec3::new(x, 0.0, 2.0)),
    ///     w: Vec3::NEG_Z,
    ///     phi: 1.0,
    ///     cos_theta_o: 1.0,
    ///     cos_theta_e: 0.0,
    ///     two_sided: false,
    /// };
    /// let lights: Vec<_> = (0..100).map(|i| LightExtent::Bounded(lamp(i as f32))).collect();
    /// let tree = LightBvh::build(&lights)?;
    /// let here = LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z);
    /// let (mut sum, mut brightest) = (0.0, 0.0);
    /// tree.view().for_each_pmf(&here, |_, pmf| {
    ///     sum += pmf;
    ///     brightest = f32::max(brightest, pmf);
    /// });
    /// assert!((sum - 1.0).abs() < 1e-4 && brightest > 0.1);
    /// # Ok::<(), light_bvh::LightBvhError>(())
    /// ```
    pub fn for_each_pmf(&self, receiver: impl IntoReceiver, each: impl FnMut(LightId, f32)) {
        let tree = &self.wanting(receiver.groups());
        dispatch(QueryFor(&receiver.keep(), Pass { tree, each }));
    }
}

/// [`LightBvhRef::for_each_pmf`].
struct Pass<'a, 'b, F> {
    tree: &'b LightBvhRef<'a>,
    each: F,
}

impl<F: FnMut(LightId, f32)> Query for Pass<'_, '_, F> {
    type Output = ();

    #[inline(always)]
    fn run<R: Receiver>(mut self, receiver: &R) {
        let nodes = self.tree.nodes();
        // The probability of reaching each node; parents come before their children.
        let mut reached = alloc::vec![0.0; nodes.len()];
        if let Some(root) = reached.first_mut() {
            *root = 1.0;
        }
        for (index, node) in nodes.iter().enumerate() {
            let pmf = reached[index];
            if pmf == 0.0 {
                continue;
            }
            let weights = self.tree.weights(index, node, receiver);
            for child in 0..node.children() {
                let pmf = positive_product(pmf, weights.probability(child));
                match self.tree.child(node, child) {
                    Child::Entry(entry) if pmf > 0.0 => {
                        if let Some(light) = self.tree.light(entry) {
                            (self.each)(light, pmf);
                        }
                    }
                    Child::Entry(_) => {}
                    Child::Node(child) => {
                        if let Some(child) = reached.get_mut(child) {
                            *child = pmf;
                        }
                    }
                }
            }
        }
    }
}
