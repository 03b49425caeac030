use core::ops::RangeInclusive;

/// A parser of whole numbers in a range; its error names the ends.
pub(crate) fn whole(
    range: RangeInclusive<u32>,
) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let (least, most) = (range.start(), range.end());
        number.ok_or_else(|| format!("expected a whole number from {least} to {most}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_expected_is_said_whatever_is_wrong() {
        let parse = whole(1..=20);
        assert_eq!(parse("1"), Ok(1), "the least");
        assert_eq!(parse("20"), Ok(20), "the most");
        let expected = Err("expected a whole number from 1 to 20".to_owned());
        for bad in [
            "0",
            "21",
            "-1",
            "1e3",
            "1.5",
            "",
            "x",
            "99999999999999999999",
        ] {
            assert_eq!(parse(bad), expected, "{bad}");
        }
    }
}
