use core::fmt::{self, Display};

use serde::ser::{self, Serialize, Serializer};
use sha2::{Digest, Sha256};

use crate::file_checksum::hex;

/// A 128-bit digest of a value: of every field of every struct in it, every element, every bit of
/// every number. Values that differ anywhere have different digests, on all
/// platforms and for any number of threads.
pub(crate) fn content_digest(value: &impl Serialize) -> String {
    let mut content = Content {
        hash: Sha256::new(),
        waiting: Vec::with_capacity(Content::BLOCK),
    };
    // Lists of unknown length are the only failure, and no scene has one.
    let written = value.serialize(&mut content);
    debug_assert!(written.is_ok(), "a list of unknown length");
    content.hash.update(&content.waiting);
    hex(&content.hash.finalize()[..16])
}

/// Serialises a value into bytes: numbers in little-endian order; lists and texts after their
/// length; variants after their name. No two values of a type have the same bytes.
struct Content {
    hash: Sha256,
    /// Bytes for the hash, which is slow at single numbers.
    waiting: Vec<u8>,
}

type Written = Result<(), fmt::Error>;

impl Content {
    /// How many bytes wait at most.
    const BLOCK: usize = 1 << 12;

    #[inline]
    fn bytes(&mut self, bytes: &[u8]) -> Written {
        if self.waiting.len() + bytes.len() > Self::BLOCK {
            self.hash.update(&self.waiting);
            self.waiting.clear();
        }
        if bytes.len() > Self::BLOCK {
            self.hash.update(bytes);
        } else {
            self.waiting.extend_from_slice(bytes);
        }
        Ok(())
    }

    fn length(&mut self, length: usize) -> Written {
        self.bytes(&(length as u64).to_le_bytes())
    }

    fn text(&mut self, text: &str) -> Written {
        self.length(text.len())?;
        self.bytes(text.as_bytes())
    }
}

macro_rules! numbers {
    ($($method:ident: $number:ty,)*) => {
        $(fn $method(self, number: $number) -> Written {
            self.bytes(&number.to_le_bytes())
        })*
    };
}

impl Serializer for &mut Content {
    type Ok = ();
    type Error = fmt::Error;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    numbers! {
        serialize_i8: i8,
        serialize_i16: i16,
        serialize_i32: i32,
        serialize_i64: i64,
        serialize_i128: i128,
        serialize_u8: u8,
        serialize_u16: u16,
        serialize_u32: u32,
        serialize_u64: u64,
        serialize_u128: u128,
        serialize_f32: f32,
        serialize_f64: f64,
    }

    fn serialize_bool(self, x: bool) -> Written {
        self.bytes(&[x.into()])
    }

    fn serialize_char(self, x: char) -> Written {
        self.bytes(&u32::from(x).to_le_bytes())
    }

    fn serialize_str(self, text: &str) -> Written {
        self.text(text)
    }

    fn serialize_bytes(self, bytes: &[u8]) -> Written {
        self.length(bytes.len())?;
        self.bytes(bytes)
    }

    fn serialize_none(self) -> Written {
        self.bytes(&[0])
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Written {
        self.bytes(&[1])?;
        value.serialize(self)
    }

    fn serialize_unit(self) -> Written {
        Ok(())
    }

    fn serialize_unit_struct(self, _: &'static str) -> Written {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, variant: &'static str) -> Written {
        self.text(variant)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Written {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Written {
        self.text(variant)?;
        value.serialize(self)
    }

    fn serialize_seq(self, length: Option<usize>) -> Result<Self, fmt::Error> {
        self.length(length.ok_or(fmt::Error)?)?;
        Ok(self)
    }

    fn serialize_tuple(self, _: usize) -> Result<Self, fmt::Error> {
        Ok(self)
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Self, fmt::Error> {
        Ok(self)
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self, fmt::Error> {
        self.text(variant)?;
        Ok(self)
    }

    fn serialize_map(self, length: Option<usize>) -> Result<Self, fmt::Error> {
        self.serialize_seq(length)
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Self, fmt::Error> {
        Ok(self)
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        _: usize,
    ) -> Result<Self, fmt::Error> {
        self.text(variant)?;
        Ok(self)
    }

    fn collect_str<T: Display + ?Sized>(self, value: &T) -> Written {
        self.text(&value.to_string())
    }

    fn is_human_readable(&self) -> bool {
        false
    }
}

macro_rules! parts {
    ($($kind:ident: $method:ident($($name:ty)?),)*) => {
        $(impl ser::$kind for &mut Content {
            type Ok = ();
            type Error = fmt::Error;

            fn $method<T: Serialize + ?Sized>(&mut self, $(_: $name,)? value: &T) -> Written {
                value.serialize(&mut **self)
            }

            fn end(self) -> Written {
                Ok(())
            }
        })*
    };
}

parts! {
    SerializeSeq: serialize_element(),
    SerializeTuple: serialize_element(),
    SerializeTupleStruct: serialize_field(),
    SerializeTupleVariant: serialize_field(),
    SerializeStruct: serialize_field(&'static str),
    SerializeStructVariant: serialize_field(&'static str),
}

impl ser::SerializeMap for &mut Content {
    type Ok = ();
    type Error = fmt::Error;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Written {
        key.serialize(&mut **self)
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Written {
        value.serialize(&mut **self)
    }

    fn end(self) -> Written {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lights::glam::Vec3;

    #[test]
    fn digests_are_known_on_every_platform() {
        // The first half of SHA-256 of one number, its lowest byte first.
        let one = content_digest(&1u32);
        assert_eq!(
            one, "67abdd721024f0ff4e0b3f4c2fc13bc5",
            "sha256 of 01 00 00 00"
        );
        assert_eq!(
            content_digest(&()),
            "e3b0c44298fc1c149afbf4c8996fb924",
            "of nothing"
        );
    }

    #[test]
    fn what_differs_has_different_digests() {
        let digests = [
            content_digest(&Vec3::ZERO),
            content_digest(&Vec3::new(0.0, 0.0, -0.0)),
            content_digest(&Vec3::new(0.0, 0.0, f32::from_bits(1))),
            content_digest(&vec![Vec3::ZERO]),
            content_digest(&[vec![1u8], vec![]]),
            content_digest(&[vec![], vec![1u8]]),
            content_digest(&["ab", "c"]),
            content_digest(&["a", "bc"]),
            content_digest(&Some(0u8)),
            content_digest(&None::<u8>),
            content_digest(&Result::<u8, u8>::Ok(1)),
            content_digest(&Result::<u8, u8>::Err(1)),
        ];
        for (i, digest) in digests.iter().enumerate() {
            assert_eq!(digest.len(), 32, "128 bits");
            assert!(!digests[..i].contains(digest), "the digest of value {i}");
        }
    }
}
