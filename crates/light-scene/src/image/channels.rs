use std::io::Cursor;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, Error, FlatSamples, Image, Layer,
    LayerAttributes, MetaData, ReadChannels, ReadLayers, Text, Vec2, WritableImage, read,
};

use super::openexr::message;
use crate::text::read_bytes;
use crate::{Diagnostic, write_atomically};

/// The most numbers per byte of a file: no method of compression exceeds it.
const DENSEST: usize = 4096;

/// The content of an OpenEXR file: channels by name, and custom attributes.
///
/// For pictures with more than colour. Colour alone is read by
/// [`read_image`](crate::read_image).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChannelFile {
    /// Numbers per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Name and float32 numbers of each channel, row by row from the top.
    pub channels: Vec<(String, Vec<f32>)>,
    /// Name and 32-bit integers of each channel that holds such.
    pub integers: Vec<(String, Vec<u32>)>,
    /// Name and text of each note (a custom attribute).
    pub notes: Vec<(String, String)>,
}

impl ChannelFile {
    /// Reads the first layer of an OpenEXR file; channels of half floats and notes of other than
    /// text are left out.
    ///
    /// # Errors
    /// When the file cannot be read or is broken.
    pub fn read(path: &Path) -> Result<Self, Diagnostic> {
        Self::parse(path, &read_bytes(path)?)
    }

    /// As [`read`](Self::read), from the bytes of the file; `path` names it in messages.
    ///
    /// # Errors
    /// When the file is broken, or says that it holds more than so many bytes can.
    pub fn parse(path: &Path, bytes: &[u8]) -> Result<Self, Diagnostic> {
        let refuse = |error: Error| Diagnostic::file(path, message(&error));
        let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(refuse)?;
        let numbers = meta.headers.iter().map(|header| {
            let pixels = header.layer_size.0.checked_mul(header.layer_size.1);
            pixels.and_then(|pixels| pixels.checked_mul(header.channels.list.len()))
        });
        if numbers
            .into_iter()
            .any(|n| n.is_none_or(|n| n / DENSEST > bytes.len()))
        {
            return Err(Diagnostic::file(
                path,
                "expected as many pixels as the file says",
            ));
        }
        let reader = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes();
        let image = reader.from_buffered(Cursor::new(bytes)).map_err(refuse)?;
        let layer = image.layer_data;
        let side = |n: usize| {
            u32::try_from(n).map_err(|_| Diagnostic::file(path, "expected a smaller image"))
        };
        let (mut channels, mut integers) = (vec![], vec![]);
        for channel in layer.channel_data.list {
            match channel.sample_data {
                FlatSamples::F32(numbers) => channels.push((channel.name.to_string(), numbers)),
                FlatSamples::U32(numbers) => integers.push((channel.name.to_string(), numbers)),
                FlatSamples::F16(_) => {}
            }
        }
        Ok(Self {
            width: side(layer.size.0)?,
            height: side(layer.size.1)?,
            channels,
            integers,
            notes: layer
                .attributes
                .other
                .into_iter()
                .filter_map(|(name, value)| match value {
                    AttributeValue::Text(text) => Some((name.to_string(), text.to_string())),
                    _ => None,
                })
                .collect(),
        })
    }

    /// Writes the file, compressed without loss.
    ///
    /// # Errors
    /// When the file cannot be written, or a channel does not fit the size; nothing is left behind
    /// then.
    pub fn write(self, path: &Path) -> Result<(), Diagnostic> {
        write_atomically(path, &self.into_bytes(path)?)
    }

    /// What [`write`](Self::write) writes; `path` names the file in messages.
    ///
    /// # Errors
    /// When a channel does not fit the size.
    pub fn into_bytes(self, path: &Path) -> Result<Vec<u8>, Diagnostic> {
        let size = Vec2(self.width as usize, self.height as usize);
        let floats = self.channels.iter().map(|(_, numbers)| numbers.len());
        let mut lengths = floats.chain(self.integers.iter().map(|(_, numbers)| numbers.len()));
        if lengths.any(|length| length != size.area()) {
            return Err(Diagnostic::file(path, "a channel does not fit the size"));
        }
        let floats = self.channels.into_iter();
        let floats = floats.map(|(name, numbers)| (name, FlatSamples::F32(numbers)));
        let integers = self.integers.into_iter();
        let integers = integers.map(|(name, numbers)| (name, FlatSamples::U32(numbers)));
        let channels = floats.chain(integers);
        let channels = channels.map(|(name, samples)| AnyChannel::new(name.as_str(), samples));
        let mut attributes = LayerAttributes {
            software_name: Some(Text::from("lights")),
            ..LayerAttributes::default()
        };
        for (name, text) in &self.notes {
            let value = AttributeValue::Text(Text::from(text.as_str()));
            attributes.other.insert(Text::from(name.as_str()), value);
        }
        let channels = AnyChannels::sort(channels.collect());
        let layer = Layer::new(size, attributes, Encoding::SMALL_FAST_LOSSLESS, channels);
        let mut bytes = Cursor::new(Vec::new());
        // One thread, so that blocks come in the same order every time.
        let image = Image::from_layer(layer);
        let written = image.write().non_parallel().to_buffered(&mut bytes);
        written.map_err(|error| Diagnostic::file(path, message(&error)))?;
        Ok(bytes.into_inner())
    }

    /// The numbers of a channel.
    #[must_use]
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        let found = self.channels.iter().find(|(other, _)| other == name);
        found.map(|(_, numbers)| numbers.as_slice())
    }

    /// The integers of a channel.
    #[must_use]
    pub fn integers(&self, name: &str) -> Option<&[u32]> {
        let found = self.integers.iter().find(|(other, _)| other == name);
        found.map(|(_, numbers)| numbers.as_slice())
    }

    /// The text of a note.
    #[must_use]
    pub fn note(&self, name: &str) -> Option<&str> {
        let found = self.notes.iter().find(|(other, _)| other == name);
        found.map(|(_, text)| text.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_folder::TestFolder;

    #[test]
    fn channels_and_notes_come_back() {
        let folder = TestFolder::new("channels");
        let path = folder.path("a.exr");
        let file = ChannelFile {
            width: 3,
            height: 2,
            channels: vec![
                ("B".into(), vec![0.25, 1e-30, 3.5, -4.0, 5.0, 6.0]),
                ("sum.0.R".into(), vec![1e30, 2.0, 3.0, 4.0, 5.0, 0.1]),
            ],
            integers: vec![("id".into(), vec![0, 1, u32::MAX, 3, 4, 5])],
            notes: vec![("samples".into(), "0..4".into())],
        };
        file.clone().write(&path).expect("written");
        let back = ChannelFile::read(&path).expect("read");
        assert_eq!(back, file, "every bit");
        assert_eq!(back.note("samples"), Some("0..4"), "by name");
        assert_eq!(back.channel("R"), None, "not there");
        assert_eq!(
            back.integers("id"),
            Some(&file.integers[0].1[..]),
            "by name"
        );
    }

    #[test]
    fn a_channel_must_fit() {
        let folder = TestFolder::new("channels-misfit");
        let file = ChannelFile {
            width: 1,
            height: 1,
            channels: vec![("R".into(), vec![])],
            ..ChannelFile::default()
        };
        let path = folder.path("a.exr");
        assert!(file.write(&path).is_err(), "no number for one pixel");
        assert!(!path.exists(), "nothing is written");
    }
}
