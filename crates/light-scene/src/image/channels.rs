use std::io::Cursor;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, Error, FlatSamples, Image, Layer,
    LayerAttributes, ReadChannels, ReadLayers, Text, Vec2, WritableImage, read,
};

use super::openexr::message;
use crate::text::read_bytes;
use crate::{Diagnostic, write_whole};

/// An OpenEXR file as it is: any channels by name, and notes beside them.
///
/// For pictures that hold more than colour. Colour alone is read by [`read_image`](crate::read_image).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChannelFile {
    /// Numbers a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Name and float32 numbers of each channel, row by row from the top.
    pub channels: Vec<(String, Vec<f32>)>,
    /// Name and text of each note (a custom attribute).
    pub notes: Vec<(String, String)>,
}

impl ChannelFile {
    /// Reads the first layer of an OpenEXR file; channels of other than float32 numbers and notes of other than text are
    /// left out.
    ///
    /// # Errors
    /// When the file cannot be read or is broken.
    pub fn read(path: &Path) -> Result<Self, Diagnostic> {
        let bytes = read_bytes(path)?;
        let reader = read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes();
        let refuse = |error: Error| Diagnostic::file(path, message(&error));
        let image = reader.from_buffered(Cursor::new(bytes)).map_err(refuse)?;
        let layer = image.layer_data;
        let side = |n: usize| {
            u32::try_from(n).map_err(|_| Diagnostic::file(path, "expected a smaller image"))
        };
        Ok(Self {
            width: side(layer.size.0)?,
            height: side(layer.size.1)?,
            channels: layer
                .channel_data
                .list
                .into_iter()
                .filter_map(|channel| match channel.sample_data {
                    FlatSamples::F32(numbers) => Some((channel.name.to_string(), numbers)),
                    FlatSamples::F16(_) | FlatSamples::U32(_) => None,
                })
                .collect(),
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
    /// When the file cannot be written, or a channel does not fit the size; nothing is left behind then.
    pub fn write(&self, path: &Path) -> Result<(), Diagnostic> {
        let size = Vec2(self.width as usize, self.height as usize);
        if self
            .channels
            .iter()
            .any(|(_, numbers)| numbers.len() != size.area())
        {
            return Err(Diagnostic::file(path, "a channel does not fit the size"));
        }
        let channels = self.channels.iter().map(|(name, numbers)| {
            AnyChannel::new(name.as_str(), FlatSamples::F32(numbers.clone()))
        });
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
        write_whole(path, bytes.get_ref())
    }

    /// The numbers of a channel.
    #[must_use]
    pub fn channel(&self, name: &str) -> Option<&[f32]> {
        let found = self.channels.iter().find(|(other, _)| other == name);
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
            notes: vec![("samples".into(), "0..4".into())],
        };
        file.write(&path).expect("written");
        let back = ChannelFile::read(&path).expect("read");
        assert_eq!(back, file, "every bit");
        assert_eq!(back.note("samples"), Some("0..4"), "by name");
        assert_eq!(back.channel("R"), None, "not there");
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
