use crate::node::light_emission::Shape;
use crate::node::moments::Moments;
use crate::node::wide_node::WIDTH;

/// The children of a node side by side, so that the compiler computes all of them together.
pub(crate) struct ChildrenSoa {
    /// 0 where there is no child, or one that is off; such lanes repeat another one.
    pub(crate) power: [f32; WIDTH],
    pub(crate) low: [[f32; WIDTH]; 3],
    pub(crate) high: [[f32; WIDTH]; 3],
    pub(crate) mean: [[f32; WIDTH]; 3],
    pub(crate) axis: [[f32; WIDTH]; 3],
    pub(crate) offset: [f32; WIDTH],
    pub(crate) spread_sq: [f32; WIDTH],
    pub(crate) both_sides: [bool; WIDTH],
    pub(crate) is_step: [bool; WIDTH],
    pub(crate) is_mean: [bool; WIDTH],
}

impl ChildrenSoa {
    /// `some` is one of them that is on.
    #[inline(always)]
    pub(crate) fn new(children: &[Moments], some: &Moments) -> Self {
        let child = |k: usize| children.get(k).filter(|c| c.power > 0.0);
        let mut children = Self {
            power: core::array::from_fn(|k| child(k).map_or(0.0, |c| c.power)),
            low: [[0.0; WIDTH]; 3],
            high: [[0.0; WIDTH]; 3],
            mean: [[0.0; WIDTH]; 3],
            axis: [[0.0; WIDTH]; 3],
            offset: [0.0; WIDTH],
            spread_sq: [0.0; WIDTH],
            both_sides: [false; WIDTH],
            is_step: [false; WIDTH],
            is_mean: [false; WIDTH],
        };
        for k in 0..WIDTH {
            let child = child(k).unwrap_or(some);
            let coded_axis = child.coded_axis();
            for axis in 0..3 {
                children.low[axis][k] = child.bounds.min[axis];
                children.high[axis][k] = child.bounds.max[axis];
                children.mean[axis][k] = child.mean[axis];
                children.axis[axis][k] = coded_axis[axis];
            }
            children.offset[k] = child.offset;
            children.spread_sq[k] = child.total_spread_sq();
            children.is_step[k] = child.shape == Shape::Steps;
            children.is_mean[k] = child.is_mean;
            children.both_sides[k] = child.shape == Shape::BothSides;
        }
        children
    }
}
