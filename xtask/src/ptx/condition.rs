//! The conditions of `#[cfg(...)]`, as they are for the kernels.

use std::collections::BTreeSet;

use syn::punctuated::Punctuated;
use syn::{Expr, ExprLit, Lit, Meta, MetaNameValue, Token};

/// The architecture of the kernels.
const ARCHITECTURE: &str = "nvptx64";

/// Whether a condition holds for the kernels; `None` where that is not known.
pub(super) fn holds(condition: &Meta, features: &BTreeSet<String>) -> Option<bool> {
    let list = match condition {
        Meta::Path(path) => return path.is_ident("test").then_some(false),
        Meta::NameValue(pair) => {
            let value = text_of(condition)?;
            return if pair.path.is_ident("feature") {
                Some(features.contains(&value))
            } else {
                let is_ours = value == ARCHITECTURE;
                pair.path.is_ident("target_arch").then_some(is_ours)
            };
        }
        Meta::List(list) => list,
    };
    let parts = list
        .parse_args_with(Punctuated::<Meta, Token![,]>::parse_terminated)
        .ok()?;
    let parts: Vec<Option<bool>> = parts.iter().map(|part| holds(part, features)).collect();
    if list.path.is_ident("not") {
        return parts[..].first()?.map(|holds| !holds);
    }
    // One such part decides.
    let decides = list.path.is_ident("any");
    if parts.contains(&Some(decides)) {
        Some(decides)
    } else if parts.contains(&None) {
        None
    } else {
        Some(!decides)
    }
}

/// The text in `name = "text"`.
pub(super) fn text_of(attribute: &Meta) -> Option<String> {
    match attribute {
        Meta::NameValue(MetaNameValue {
            value:
                Expr::Lit(ExprLit {
                    lit: Lit::Str(text),
                    ..
                }),
            ..
        }) => Some(text.value()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_are_those_of_the_kernels() {
        let features = BTreeSet::from(["libm".to_owned()]);
        for (condition, expected) in [
            ("cfg(test)", Some(false)),
            ("cfg(feature = \"libm\")", Some(true)),
            ("cfg(feature = \"std\")", Some(false)),
            ("cfg(not(feature = \"std\"))", Some(true)),
            ("cfg(target_arch = \"nvptx64\")", Some(true)),
            ("cfg(any(test, feature = \"libm\"))", Some(true)),
            ("cfg(any(test, feature = \"std\"))", Some(false)),
            ("cfg(all(test, feature = \"libm\"))", Some(false)),
            ("cfg(avx512)", None),
            ("cfg(not(avx512))", None),
            ("cfg(all(avx512, feature = \"libm\"))", None),
            ("cfg(all(avx512, feature = \"std\"))", Some(false)),
            ("cfg(any(avx512, feature = \"libm\"))", Some(true)),
        ] {
            let meta = syn::parse_str(condition).expect("an attribute");
            assert_eq!(holds(&meta, &features), expected, "{condition}");
        }
    }
}
