use lights::math::glam::{Vec2, Vec3};
use serde_json::Value;

/// Why a line could not be understood.
#[derive(Debug)]
pub struct Malformed(pub String);

/// A value of a vector line, with accessors that know how these files write numbers: not-a-number
/// and the infinities are the strings `"nan"`, `"inf"`, `"-inf"`.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a>(&'a Value);

impl<'a> Case<'a> {
    /// Wraps a parsed line.
    #[must_use]
    pub const fn new(value: &'a Value) -> Self {
        Self(value)
    }

    /// The field `name`.
    ///
    /// # Errors
    /// If there is none.
    pub fn get(&self, name: &str) -> Result<Self, Malformed> {
        self.find(name)
            .ok_or_else(|| Malformed(format!("no field `{name}`")))
    }

    /// The field `name`, none if it is missing or null.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Self> {
        self.0.get(name).map(Self).filter(|value| !value.is_null())
    }

    /// Element `index` of an array.
    ///
    /// # Errors
    /// If there is none.
    pub fn at(&self, index: usize) -> Result<Self, Malformed> {
        self.0
            .get(index)
            .map(Self)
            .ok_or_else(|| Malformed(format!("no element {index} in {}", self.0)))
    }

    /// Whether the value is null.
    #[must_use]
    pub fn is_null(&self) -> bool {
        self.0.is_null()
    }

    /// The value as a text, if it is one.
    #[must_use]
    pub fn text(&self) -> Option<&'a str> {
        self.0.as_str()
    }

    /// The elements of an array.
    ///
    /// # Errors
    /// If the value is not an array.
    pub fn items(&self) -> Result<impl Iterator<Item = Self> + use<'a>, Malformed> {
        Ok(self.array()?.iter().map(Self))
    }

    /// A float, as the `f32` that was printed.
    ///
    /// # Errors
    /// If the value is neither a number nor one of the three strings.
    pub fn float(&self) -> Result<f32, Malformed> {
        match self.0 {
            Value::Number(number) => number.as_f64().map(|x| x as f32),
            Value::String(text) => match text.as_str() {
                "nan" => Some(f32::NAN),
                "inf" => Some(f32::INFINITY),
                "-inf" => Some(f32::NEG_INFINITY),
                _ => None,
            },
            _ => None,
        }
        .ok_or_else(|| self.not_a("float"))
    }

    /// An integer, -1 included where a file uses it for "none".
    ///
    /// # Errors
    /// If the value is not an integer.
    pub fn integer(&self) -> Result<i64, Malformed> {
        self.0.as_i64().ok_or_else(|| self.not_a("whole number"))
    }

    /// A number that counts or indexes.
    ///
    /// # Errors
    /// If the value is not an integer from 0.
    pub fn index(&self) -> Result<usize, Malformed> {
        usize::try_from(self.integer()?).map_err(|_| self.not_a("index"))
    }

    /// A truth value.
    ///
    /// # Errors
    /// If the value is not a boolean.
    pub fn flag(&self) -> Result<bool, Malformed> {
        self.0.as_bool().ok_or_else(|| self.not_a("boolean"))
    }

    /// An array of floats.
    ///
    /// # Errors
    /// If the value is something else.
    pub fn floats(&self) -> Result<Vec<f32>, Malformed> {
        self.items()?.map(|item| item.float()).collect()
    }

    /// An array of `N` floats.
    ///
    /// # Errors
    /// If the value is something else.
    pub fn float_array<const N: usize>(&self) -> Result<[f32; N], Malformed> {
        <[f32; N]>::try_from(self.floats()?).map_err(|_| self.not_a(&format!("{N} floats")))
    }

    /// Two floats.
    ///
    /// # Errors
    /// If the value is something else.
    pub fn vec2(&self) -> Result<Vec2, Malformed> {
        self.float_array().map(Vec2::from_array)
    }

    /// Three floats.
    ///
    /// # Errors
    /// If the value is something else.
    pub fn vec3(&self) -> Result<Vec3, Malformed> {
        self.float_array().map(Vec3::from_array)
    }

    fn array(&self) -> Result<&'a Vec<Value>, Malformed> {
        self.0.as_array().ok_or_else(|| self.not_a("array"))
    }

    fn not_a(&self, wanted: &str) -> Malformed {
        Malformed(format!("{} is no {wanted}", self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_floats_that_json_lacks() {
        let value = serde_json::from_str(r#"{"a":["nan","inf","-inf",0.1,-0.0],"b":null}"#)
            .expect("well-formed");
        let case = Case::new(&value);
        let a = case.get("a").and_then(|a| a.floats()).expect("floats");
        assert!(a[0].is_nan(), "not a number");
        assert_eq!(
            &a[1..4],
            &[f32::INFINITY, f32::NEG_INFINITY, 0.1],
            "the others"
        );
        assert!(a[4].is_sign_negative(), "negative zero");
        assert!(case.find("b").is_none() && case.get("c").is_err(), "absent");
    }
}
