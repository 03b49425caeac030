use light_bounds::LightExtent;

use super::LightBvh;
use super::lights::Lights;
use super::moments::Moments;
use super::node::{NOWHERE, WIDTH, WideNode};
use super::options::DarkLights;
use super::scan::Scan;
use crate::LightBvhError;
use crate::join::join;

/// Nodes of a tree count for so many lights when work is shared out.
const LIGHTS_PER_NODE: usize = 5;

impl LightBvh {
    /// Follows lights that moved, turned, or changed their power: the same tree, with what its nodes know made anew.
    ///
    /// Takes time linear in the lights and no memory. A light that is off keeps its place and has pmf 0 until it is on again. The
    /// further lights move from where they were, the looser the tree gets: see [`looseness`](Self::looseness).
    ///
    /// # Errors
    /// Those of [`build`](Self::build), [`LightBvhError::OtherLights`] if these are not as many lights as the tree was built for, and
    /// [`LightBvhError::NoPlace`] for the first one that shines, or is somewhere, and was not when the tree was built. The tree is then
    /// as it was.
    pub fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        if lights.len() != self.slots.len() {
            return Err(LightBvhError::OtherLights {
                expected: self.slots.len(),
            });
        }
        let scan = Scan::new(lights, 0, DarkLights::Kept, &|light, extent| {
            let is_in_tree = self.view().slot(light) != NOWHERE;
            let fits = match extent {
                LightExtent::Bounded(bounds) => is_in_tree || bounds.phi == 0.0,
                LightExtent::Infinite(_) => !is_in_tree,
            };
            if fits {
                Ok(())
            } else {
                Err(LightBvhError::NoPlace { light })
            }
        })?;
        let refit = Refit {
            lights: Lights::new(lights, scan.power),
            order: &self.order,
        };
        if let Some((root, below)) = self.nodes.split_first_mut() {
            refit.node(root, below, 1);
        }
        self.power = scan.power;
        Ok(())
    }
}

/// What all steps of a refit share.
struct Refit<'a> {
    lights: Lights<'a>,
    order: &'a [u32],
}

impl Refit<'_> {
    /// Makes a subtree anew. `below` are the nodes below `node`, and `base` is the place of the first of them in the tree.
    fn node(&self, node: &mut WideNode, below: &mut [WideNode], base: usize) -> Moments {
        let (inner, count) = (usize::from(node.inner), usize::from(node.count));
        let mut moments = [Moments::NOTHING; WIDTH];
        let lights = &self.order[node.light_base as usize..];
        for (moments, &light) in moments[inner..count].iter_mut().zip(lights) {
            *moments = self.lights.moments(light);
        }
        let (children, rest) = below.split_at_mut(inner);
        self.nodes(children, rest, base + inner, &mut moments[..inner]);
        *node = WideNode {
            child_base: node.child_base,
            light_base: node.light_base,
            inner: node.inner,
            parent: node.parent,
            ..WideNode::encode(&moments[..count])
        };
        Moments::join(&moments[..count])
    }

    /// The same for nodes side by side; `below` are the nodes below all of them, in their order.
    fn nodes(
        &self,
        nodes: &mut [WideNode],
        below: &mut [WideNode],
        base: usize,
        moments: &mut [Moments],
    ) {
        match nodes {
            [] => {}
            [node] => moments[0] = self.node(node, below, base),
            _ => {
                let middle = nodes.len() / 2;
                let work = LIGHTS_PER_NODE * below.len();
                let (nodes, later) = nodes.split_at_mut(middle);
                // What is below the second half begins at the children of its first node.
                let border = later[0].child_base as usize;
                let (below, below_later) = below.split_at_mut(border - base);
                let (moments, moments_later) = moments.split_at_mut(middle);
                join(
                    work,
                    || self.nodes(nodes, below, base, moments),
                    || self.nodes(later, below_later, border, moments_later),
                );
            }
        }
    }
}
