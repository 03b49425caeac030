use serde_json::{Map, Value};

use super::document::{Document, found};
use crate::Diagnostic;
use crate::text::shown;

/// A part of a document.
#[derive(Clone, Debug)]
pub(super) struct Item<'a> {
    pub(super) document: &'a Document,
    pub(super) value: &'a Value,
    /// From the root: `nodes[3].mesh`; empty for the root itself.
    pub(super) path: String,
}

impl Document {
    /// The part that holds all others.
    pub(super) fn root(&self) -> Item<'_> {
        Item {
            document: self,
            value: &self.root,
            path: String::new(),
        }
    }

    /// A part that a reader visits: it is not among the unread ones.
    pub(super) fn visit<'a>(&'a self, value: &'a Value, path: String) -> Item<'a> {
        self.visited.borrow_mut().insert(core::ptr::from_ref(value));
        Item {
            document: self,
            value,
            path,
        }
    }
}

impl<'a> Item<'a> {
    /// A message about this part.
    pub(super) fn error(&self, message: &str) -> Diagnostic {
        let separator = if self.path.is_empty() { "" } else { ": " };
        let message = format!("{}{separator}{message}", self.path);
        Diagnostic::file(self.document.path(), message)
    }

    /// The message that something else was expected.
    pub(super) fn expected(&self, what: &str) -> Diagnostic {
        self.error(&format!("expected {what}, found {}", found(self.value)))
    }

    /// The path without list indices.
    pub(super) fn kind(&self) -> String {
        let mut inside = false;
        let keep = |c: &char| {
            let was_inside = inside;
            inside = *c == '[' || (inside && *c != ']');
            !inside && !was_inside
        };
        self.path.chars().filter(keep).collect()
    }

    fn map(&self) -> Result<&'a Map<String, Value>, Diagnostic> {
        self.value
            .as_object()
            .ok_or_else(|| self.expected("an object"))
    }

    /// A member of this object, if it is there.
    pub(super) fn get(&self, name: &str) -> Result<Option<Self>, Diagnostic> {
        let value = self.map()?.get(name);
        Ok(value.map(|value| self.document.visit(value, joined(&self.path, name))))
    }

    /// A required member of this object.
    pub(super) fn require(&self, name: &str) -> Result<Self, Diagnostic> {
        let member = self.get(name)?;
        member.ok_or_else(|| self.error(&format!("expected a member `{name}`")))
    }

    /// The object of an extension in this object.
    pub(super) fn extension(&self, name: &str) -> Result<Option<Self>, Diagnostic> {
        let extensions = self.get("extensions")?;
        extensions.map_or(Ok(None), |extensions| extensions.get(name))
    }

    /// The elements of a member that is a list; `None` if it is not there.
    pub(super) fn list(&self, name: &str) -> Result<Vec<Self>, Diagnostic> {
        let Some(list) = self.get(name)? else {
            return Ok(Vec::new());
        };
        (0..list.array()?.len())
            .map(|index| list.element(index))
            .collect()
    }

    fn array(&self) -> Result<&'a [Value], Diagnostic> {
        let array = self.value.as_array().map(Vec::as_slice);
        array.ok_or_else(|| self.expected("a list"))
    }

    fn element(&self, index: usize) -> Result<Self, Diagnostic> {
        let array = self.array()?;
        let value = array.get(index).ok_or_else(|| {
            self.error(&format!(
                "element {index} of {} does not exist",
                array.len()
            ))
        })?;
        Ok(self
            .document
            .visit(value, format!("{}[{index}]", self.path)))
    }

    /// The element of a list of the root that this index refers to.
    pub(super) fn target(&self, list: &str) -> Result<(usize, Self), Diagnostic> {
        self.target_in(&self.document.root(), list)
    }

    /// The element of a list of `owner` that this index refers to.
    pub(super) fn target_in(&self, owner: &Self, list: &str) -> Result<(usize, Self), Diagnostic> {
        let index = self.whole()?;
        let found = owner.get(list)?.and_then(|list| list.element(index).ok());
        let message = || format!("{}[{index}] does not exist", joined(&owner.path, list));
        let found = found.ok_or_else(|| self.error(&message()))?;
        Ok((index, found))
    }

    /// This part as a whole number of at least 0.
    pub(super) fn whole(&self) -> Result<usize, Diagnostic> {
        let whole = self.value.as_u64().and_then(|n| usize::try_from(n).ok());
        whole.ok_or_else(|| self.expected("a whole number of at least 0"))
    }

    /// This part as a number.
    pub(super) fn number(&self) -> Result<f32, Diagnostic> {
        number(self.value).ok_or_else(|| self.expected("a number"))
    }

    /// This part as `N` numbers.
    pub(super) fn numbers<const N: usize>(&self) -> Result<[f32; N], Diagnostic> {
        let list = self.array()?;
        let numbers: Option<Vec<f32>> = list.iter().map(number).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        numbers.ok_or_else(|| self.error(&format!("expected {N} numbers")))
    }

    pub(super) fn text(&self) -> Result<&'a str, Diagnostic> {
        self.value.as_str().ok_or_else(|| self.expected("a text"))
    }

    /// A member that is a number.
    pub(super) fn number_or(&self, name: &str, default: f32) -> Result<f32, Diagnostic> {
        let member = self.get(name)?;
        member.map_or(Ok(default), |member| member.number())
    }

    /// A member that is a number of at least 0.
    pub(super) fn amount_or(&self, name: &str, default: f32) -> Result<f32, Diagnostic> {
        let Some(member) = self.get(name)? else {
            return Ok(default);
        };
        let number = member.number()?;
        if number < 0.0 {
            return Err(member.expected("a number of at least 0"));
        }
        Ok(number)
    }

    /// A member that is a number from 0 to 1.
    pub(super) fn share_or(&self, name: &str, default: f32) -> Result<f32, Diagnostic> {
        let Some(member) = self.get(name)? else {
            return Ok(default);
        };
        let number = member.number()?;
        share(number).ok_or_else(|| member.expected("a number from 0 to 1"))
    }

    /// A member that is a list of numbers from 0 to 1.
    pub(super) fn shares_or<const N: usize>(
        &self,
        name: &str,
        default: [f32; N],
    ) -> Result<[f32; N], Diagnostic> {
        let shares = self.numbers_or(name, default)?.map(share);
        if shares.contains(&None) {
            return Err(self.error(&format!("expected a `{name}` from 0 to 1")));
        }
        Ok(shares.map(Option::unwrap_or_default))
    }

    pub(super) fn numbers_or<const N: usize>(
        &self,
        name: &str,
        default: [f32; N],
    ) -> Result<[f32; N], Diagnostic> {
        let member = self.get(name)?;
        member.map_or(Ok(default), |member| member.numbers())
    }

    pub(super) fn whole_or(&self, name: &str, default: usize) -> Result<usize, Diagnostic> {
        let member = self.get(name)?;
        member.map_or(Ok(default), |member| member.whole())
    }

    pub(super) fn is_true(&self, name: &str) -> Result<bool, Diagnostic> {
        let Some(member) = self.get(name)? else {
            return Ok(false);
        };
        let truth = member.value.as_bool();
        truth.ok_or_else(|| member.expected("`true` or `false`"))
    }

    /// The name of this object; may be empty.
    pub(super) fn name(&self) -> &'a str {
        self.value
            .get("name")
            .and_then(Value::as_str)
            .unwrap_or_default()
    }
}

/// A number that is finite as `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounded once")]
fn number(value: &Value) -> Option<f32> {
    let number = value.as_f64()? as f32;
    number.is_finite().then_some(number)
}

/// A number from 0 to 1, with a tolerance for rounding by exporters.
fn share(number: f32) -> Option<f32> {
    const ROUNDING: f32 = 1e-3;
    let is_near = (-ROUNDING..=1.0 + ROUNDING).contains(&number);
    is_near.then_some(number.clamp(0.0, 1.0))
}

/// The path of a member.
pub(super) fn joined(path: &str, member: &str) -> String {
    let separator = if path.is_empty() { "" } else { "." };
    format!("{path}{separator}{}", shown(member))
}

#[cfg(test)]
mod tests {
    use super::super::document::tests::document;
    use super::*;

    #[test]
    fn parts_say_where_they_are() {
        let document = document(r#"{"a": [{"b": 2}, {"b": -1}], "c": [1, 2], "a[1]": {}}"#);
        let root = document.root();
        let list = root.list("a").expect("a list");
        let b = list[1].require("b").expect("there");
        let message = |error: Diagnostic| error.to_string();
        assert_eq!(
            b.whole().map_err(message),
            Err("a.gltf: a[1].b: expected a whole number of at least 0, found -1".into()),
            "a path"
        );
        assert_eq!(b.kind(), "a.b", "without places");
        assert_eq!(
            root.require("x").map(|_| ()).map_err(message),
            Err("a.gltf: expected a member `x`".into()),
            "the root has no path"
        );
        assert_eq!(
            list[0].numbers_or::<3>("b", [0.0; 3]).map_err(message),
            Err("a.gltf: a[0].b: expected a list, found 2".into()),
            "a list"
        );
        let two = list[0].require("b").expect("there");
        assert_eq!(
            two.target("a").map(|_| ()).map_err(message),
            Err("a.gltf: a[0].b: a[2] does not exist".into()),
            "a reference"
        );
        let c = root.numbers_or::<3>("c", [0.0; 3]);
        let error = "a.gltf: c: expected 3 numbers";
        assert_eq!(c.map_err(message), Err(error.into()), "too few");
    }
}
