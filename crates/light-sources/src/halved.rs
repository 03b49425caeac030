use alloc::vec::Vec;

use crate::glam::Vec3;
use crate::image::Image;

impl Image {
    /// The image of half the size, rounded up, and the same mean: each texel is the mean of the part that it covers. `None`
    /// for a single texel.
    pub(crate) fn halved(&self) -> Option<Self> {
        if self.size() == [1, 1] {
            return None;
        }
        let size = self.size().map(|n| n.div_ceil(2));
        let channels = self.channels().count();
        let mut texels = Vec::with_capacity(channels * size[0] as usize * size[1] as usize);
        for y in 0..size[1] {
            let rows = parts(y, size[1], self.size()[1]);
            for x in 0..size[0] {
                let columns = parts(x, size[0], self.size()[0]);
                let mut mean = Vec3::ZERO;
                for &(y, height) in rows.iter().filter(|(_, height)| *height > 0.0) {
                    for &(x, width) in columns.iter().filter(|(_, width)| *width > 0.0) {
                        mean += self.texel(x, y) * (width * height);
                    }
                }
                texels.extend(&mean.to_array()[..channels]);
            }
        }
        Self::from_f32(size, self.channels(), texels).ok()
    }
}

/// What texel `i` of `coarse` that fill a line covers of `fine` ones, at most twice as many: texels, and shares of it.
#[expect(clippy::cast_possible_truncation, reason = "at most `fine`")]
fn parts(i: u32, coarse: u32, fine: u32) -> [(u32, f32); 3] {
    let [i, coarse, fine] = [i, coarse, fine].map(u64::from);
    let first = i * fine / coarse;
    [first, first + 1, first + 2].map(|j| {
        let end = ((i + 1) * fine).min((j + 1) * coarse);
        let overlap = end.saturating_sub((i * fine).max(j * coarse));
        (j as u32, overlap as f32 / fine as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::Channels;

    #[test]
    fn parts_of_a_line_cover_it_once() {
        for fine in 2..=9u32 {
            let coarse = fine.div_ceil(2);
            let mut covered = alloc::vec![0.0; fine as usize];
            for (j, share) in (0..coarse).flat_map(|i| parts(i, coarse, fine)) {
                if share > 0.0 {
                    covered[j as usize] += share;
                }
            }
            let each = coarse as f32 / fine as f32;
            let is_even = covered
                .iter()
                .all(|share: &f32| (share - each).abs() < 1e-6);
            assert!(is_even, "{fine}: {covered:?}");
        }
    }

    #[test]
    fn a_texel_is_the_mean_of_what_it_covers() {
        let texels = [0.0, 3.0, 6.0, 1.0, 4.0, 7.0];
        let image = Image::from_f32([3, 2], Channels::Gray, texels).expect("an image");
        let half = image.halved().expect("smaller");
        assert_eq!(half.size(), [2, 1], "rounded up");
        assert_eq!(half.averages(), [1.5, 5.5], "the middle column to both");
        let single = half.halved().expect("a texel");
        assert_eq!(single.averages(), [3.5], "the mean");
        assert_eq!(single.halved(), None, "the last");
    }
}
