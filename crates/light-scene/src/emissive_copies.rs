/// The most emissive quadrics in all instances of a scene, and emissive triangles of objects of one
/// or two: they are copied. This many take about 8 GB.
pub const MAX_EMISSIVE_COPIES: usize = 1 << 25;

/// The most emissive triangles and quadrics in all instances of a scene: each is a light of its own,
/// with an id of 32 bits.
pub const MAX_EMISSIVE_PRIMITIVES: usize = u32::MAX as usize;

/// The emissive triangles and quadrics of an object.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct EmissiveCount {
    pub(crate) triangles: usize,
    pub(crate) quadrics: usize,
}

/// Counts the emissive primitives of instances while a file is read.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct EmissiveCopies {
    all: usize,
    quadrics: usize,
}

impl EmissiveCopies {
    /// Counts `instances` instances of an object.
    ///
    /// # Errors
    /// A message with the limit, once it is exceeded.
    pub(crate) fn add(&mut self, object: EmissiveCount, instances: usize) -> Result<(), String> {
        let EmissiveCount {
            triangles,
            quadrics,
        } = object;
        let of_one = triangles.saturating_add(quadrics);
        let add = |sum: &mut usize, of_one: usize, most: usize, what: &str| {
            *sum = sum.saturating_add(of_one.saturating_mul(instances));
            if *sum <= most {
                return Ok(());
            }
            Err(format!(
                "expected at most {most} emissive {what} in all instances, found {sum} so far"
            ))
        };
        let most = MAX_EMISSIVE_PRIMITIVES;
        add(&mut self.all, of_one, most, "triangles and quadrics")?;
        add(
            &mut self.quadrics,
            quadrics,
            MAX_EMISSIVE_COPIES,
            "quadrics",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_and_copies_have_limits_of_their_own() {
        let object = |triangles, quadrics| EmissiveCount {
            triangles,
            quadrics,
        };
        let mut copies = EmissiveCopies::default();
        assert_eq!(copies.add(object(10_000, 0), 100_000), Ok(()), "a billion");
        assert_eq!(
            copies.add(object(0, 1 << 15), 1 << 10),
            Ok(()),
            "all copies"
        );
        let error = copies.add(object(0, 1), 1).expect_err("one more");
        assert!(
            error.starts_with("expected at most 33554432 emissive quadrics in all instances"),
            "{error}"
        );
        let left = MAX_EMISSIVE_PRIMITIVES - 1_000_000_000 - MAX_EMISSIVE_COPIES - 1;
        assert_eq!(copies.add(object(1, 0), left), Err(error), "still too many");

        let mut copies = EmissiveCopies::default();
        assert_eq!(copies.add(object(1, 0), u32::MAX as usize), Ok(()), "all");
        for more in [1, usize::MAX] {
            let error = copies.add(object(more, 0), 2).expect_err("too many");
            assert!(
                error.starts_with("expected at most 4294967295 emissive triangles and quadrics"),
                "{error}"
            );
        }
    }
}
