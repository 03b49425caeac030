use alloc::vec;
use alloc::vec::Vec;

use super::axis::{Axis, full_turn};
use super::web_type::WebType;

/// The angles of an axis completed by symmetry, and for each of them the index of the measured
/// angle with its values.
#[derive(Clone, Debug)]
pub(super) struct UnfoldedAxis {
    pub(super) angles: Vec<f32>,
    pub(super) from: Vec<usize>,
}

impl UnfoldedAxis {
    /// `None` where the angles do not fit the type.
    pub(super) fn vertical(web_type: WebType, angles: &[f32]) -> Option<Self> {
        let axis = Axis::new(angles).filter(|_| angles.len() > 1)?;
        match web_type {
            WebType::A | WebType::B => Self::mirrored(&axis),
            WebType::C => {
                (axis.first() >= 0.0 && axis.last() <= 180.0).then(|| Self::of(&axis, |a| vec![a]))
            }
        }
    }

    /// `None` where the angles do not fit the type.
    pub(super) fn horizontal(web_type: WebType, angles: &[f32]) -> Option<Self> {
        let axis = Axis::new(angles)?;
        if web_type != WebType::C {
            return Self::mirrored(&axis).filter(|_| angles.len() > 1);
        }
        let ends = (axis.first(), axis.last());
        match ends {
            (0.0, 0.0) => Some(Self::of(&axis, |_| vec![0.0, 360.0])),
            (0.0, 90.0) => Some(Self::of(&axis, |a| {
                vec![a, 180.0 - a, 180.0 + a, 360.0 - a]
            })),
            (0.0, 180.0) => Some(Self::of(&axis, |a| vec![a, 360.0 - a])),
            (90.0, 270.0) => Some(Self::of(&axis, |a| {
                let mirrored = 180.0 - a;
                vec![a, full_turn(mirrored), mirrored + 360.0]
            })),
            // A full turn, with or without its end.
            (0.0, last) if last > 180.0 && last <= 360.0 => Some(Self::of(&axis, |a| {
                if a == 0.0 { vec![0.0, 360.0] } else { vec![a] }
            })),
            _ => None,
        }
    }

    /// Angles in `[-90, 90]`, on one or both sides of 0.
    fn mirrored(axis: &Axis<'_>) -> Option<Self> {
        if axis.last() > 90.0 {
            None
        } else if axis.first() == 0.0 {
            Some(Self::of(axis, |a| vec![-a, a]))
        } else {
            (axis.first() == -axis.last()).then(|| Self::of(axis, |a| vec![a]))
        }
    }

    /// All `images` of each angle in `[-360, 360]`, sorted, without duplicates.
    fn of(axis: &Axis<'_>, images: impl Fn(f32) -> Vec<f32>) -> Self {
        let angles = axis.angles().iter().enumerate();
        let mut all: Vec<(f32, usize)> = angles
            .flat_map(|(i, &angle)| images(angle).into_iter().map(move |image| (image, i)))
            .filter(|&(image, _)| image <= 360.0)
            .collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all.dedup_by(|a, b| a.0 == b.0);
        let (angles, from) = all.into_iter().unzip();
        Self { angles, from }
    }
}
