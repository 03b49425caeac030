use core::fmt::{Display, Write as _};

/// A page under construction, in which every element that is opened is closed.
#[derive(Debug, Default)]
pub(super) struct Html {
    text: String,
}

impl Html {
    /// Adds an element with `attributes`, such as ` class="wide"`, around what `content` adds.
    pub(super) fn element(&mut self, tag: &str, attributes: &str, content: impl FnOnce(&mut Self)) {
        self.markup(format_args!("<{tag}{attributes}>"));
        content(self);
        self.markup(format_args!("</{tag}>"));
        if matches!(
            tag,
            "p" | "tr" | "table" | "section" | "figure" | "h1" | "h2"
        ) {
            self.text.push('\n');
        }
    }

    /// Adds an element that holds text.
    pub(super) fn words(&mut self, tag: &str, text: &str) {
        self.element(tag, "", |html| html.text(text));
    }

    /// Adds text, with the characters that mean something in HTML replaced.
    pub(super) fn text(&mut self, text: &str) {
        for c in text.chars() {
            match c {
                '&' => self.text.push_str("&amp;"),
                '<' => self.text.push_str("&lt;"),
                '>' => self.text.push_str("&gt;"),
                '"' => self.text.push_str("&quot;"),
                '\'' => self.text.push_str("&#39;"),
                _ => self.text.push(c),
            }
        }
    }

    /// Adds a number as a reader wants it, with all its digits for programs; a dash for `None` and
    /// for numbers that are not finite.
    pub(super) fn number(&mut self, x: Option<f64>) {
        match x.filter(|x| x.is_finite()) {
            Some(x) => self.markup(format_args!("<data value=\"{x}\">{}</data>", figure(x))),
            None => self.text.push('\u{2013}'),
        }
    }

    /// Adds markup as it is.
    pub(super) fn markup(&mut self, markup: impl Display) {
        // Writing to a string does not fail.
        let _ = write!(self.text, "{markup}");
    }

    /// The whole page.
    pub(super) fn into_text(self) -> String {
        self.text
    }
}

/// A number with three digits, or whole if it is.
pub(super) fn figure(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".into()
    } else if x.fract() == 0.0 && size < 1e7 {
        format!("{x:.0}")
    } else if (1e-3..1e5).contains(&size) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 5 digits"
        )]
        let digits = (2.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
        format!("{x:.digits$}")
    } else {
        format!("{x:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_no_markup() {
        let mut html = Html::default();
        html.words("p", "<b> & \"c'");
        assert_eq!(
            html.into_text(),
            "<p>&lt;b&gt; &amp; &quot;c&#39;</p>\n",
            "escaped"
        );
    }

    #[test]
    fn numbers_have_three_digits_and_all_of_them() {
        let figures = [0.0, 12.0, 0.123_456, 1234.5, 12.345, 1.5e-7, -2.5e9];
        let expected = ["0", "12", "0.123", "1234", "12.3", "1.50e-7", "-2.50e9"];
        assert_eq!(figures.map(figure), expected.map(String::from), "rounded");
        let mut html = Html::default();
        html.number(Some(0.123_456));
        html.number(Some(f64::NAN));
        html.number(None);
        let text = "<data value=\"0.123456\">0.123</data>\u{2013}\u{2013}";
        assert_eq!(html.into_text(), text, "for readers and programs");
    }
}
