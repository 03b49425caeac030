use alloc::rc::Rc;
use std::collections::HashMap;

use super::data_uri::{EXPECTED, Resource, resource};
use super::document::Document;
use super::item::Item;
use crate::{Diagnostic, Files};

/// The buffers of a document.
pub(super) struct Buffers<'a> {
    files: Files<'a>,
    document: &'a Document,
    buffers: Vec<Rc<[u8]>>,
}

/// Some bytes of a buffer.
#[derive(Clone, Debug)]
pub(super) struct View {
    buffer: Rc<[u8]>,
    start: usize,
    end: usize,
    /// Stride in bytes, if the view has one.
    pub(super) stride: Option<usize>,
}

impl View {
    pub(super) fn bytes(&self) -> &[u8] {
        &self.buffer[self.start..self.end]
    }
}

impl<'a> Buffers<'a> {
    /// All buffers, each file read once; `binary` is the binary chunk of a `.glb` file.
    pub(super) fn new(
        document: &'a Document,
        binary: Option<&[u8]>,
        files: Files<'a>,
    ) -> Result<Self, Diagnostic> {
        let mut all = Self {
            files,
            document,
            buffers: Vec::new(),
        };
        let mut by_uri: HashMap<&str, Rc<[u8]>> = HashMap::new();
        let items = document.root().list("buffers")?;
        for (index, item) in items.iter().enumerate() {
            let length = item.require("byteLength")?;
            let bytes = match item.get("uri")? {
                Some(uri) => match by_uri.get(uri.text()?) {
                    Some(known) => Rc::clone(known),
                    None => {
                        let bytes: Rc<[u8]> = all.load(&uri)?.into();
                        by_uri.insert(uri.text()?, Rc::clone(&bytes));
                        bytes
                    }
                },
                None if index == 0 && binary.is_some() => binary.unwrap_or_default().into(),
                None => return Err(item.error("expected a member `uri`")),
            };
            if bytes.len() < length.whole()? {
                let message = format!("as many bytes as there are, {}", bytes.len());
                return Err(length.expected(&message));
            }
            all.buffers.push(bytes);
        }
        Ok(all)
    }

    /// The source of files that a document refers to.
    pub(super) const fn files(&self) -> Files<'a> {
        self.files
    }

    /// The bytes of a URI.
    pub(super) fn load(&self, uri: &Item<'_>) -> Result<Vec<u8>, Diagnostic> {
        self.find(uri)?
            .map_err(|error| uri.error(&error.to_string()))
    }

    /// The bytes of a URI, or why its file cannot be read.
    pub(super) fn find(&self, uri: &Item<'_>) -> Result<Result<Vec<u8>, Diagnostic>, Diagnostic> {
        match resource(uri.text()?) {
            Some(Resource::Bytes(bytes)) => Ok(Ok(bytes)),
            Some(Resource::File(name)) => {
                Ok(self.files.read(&self.document.path().with_file_name(name)))
            }
            None => Err(uri.expected(EXPECTED)),
        }
    }

    /// The bytes of the view that `reference` points to.
    pub(super) fn view(&self, reference: &Item<'_>) -> Result<View, Diagnostic> {
        let (_, item) = reference.target("bufferViews")?;
        let buffer = item.require("buffer")?;
        let (index, _) = buffer.target("buffers")?;
        let buffer = Rc::clone(&self.buffers[index]);
        let start = item.whole_or("byteOffset", 0)?;
        let length = item.require("byteLength")?;
        let end = start.checked_add(length.whole()?);
        let end = end.filter(|&end| end <= buffer.len());
        let message = || format!("a part of a buffer of {} bytes", buffer.len());
        let end = end.ok_or_else(|| length.expected(&message()))?;
        let stride = item.get("byteStride")?.map(|stride| stride.whole());
        Ok(View {
            start,
            end,
            stride: stride.transpose()?,
            buffer,
        })
    }
}
