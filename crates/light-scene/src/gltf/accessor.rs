use super::buffers::{Buffers, View};
use super::item::Item;
use crate::Diagnostic;

/// The most numbers that a document may read in all, repeated reads included: 2 GiB.
const MOST_NUMBERS: usize = 1 << 29;

/// A typed part of a buffer.
#[derive(Debug)]
pub(super) struct Accessor<'a> {
    item: Item<'a>,
    count: usize,
    /// Numbers per element.
    width: usize,
    component: Component,
    normalized: bool,
    base: Option<Run>,
    /// Elements that differ from the base.
    sparse: Option<Sparse>,
}

/// Consecutive elements, with gaps if the stride is longer than an element.
#[derive(Debug)]
struct Run {
    view: View,
    offset: usize,
    stride: usize,
}

#[derive(Debug)]
struct Sparse {
    targets: Vec<usize>,
    values: Run,
}

/// The type of a stored number, in little-endian order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

/// How many numbers may still be read.
#[derive(Debug)]
pub(super) struct Budget(usize);

impl Default for Budget {
    fn default() -> Self {
        Self(MOST_NUMBERS)
    }
}

impl<'a> Accessor<'a> {
    /// The accessor that `reference` points to.
    pub(super) fn new(
        reference: &Item<'a>,
        buffers: &Buffers<'_>,
        budget: &mut Budget,
    ) -> Result<Self, Diagnostic> {
        let (_, item) = reference.target("accessors")?;
        let count = item.require("count")?;
        let kind = item.require("type")?;
        let width = match kind.text()? {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => return Err(kind.expected("SCALAR, VEC2, VEC3 or VEC4")),
        };
        let numbers = count.whole()?.checked_mul(width);
        let left = numbers.and_then(|numbers| budget.0.checked_sub(numbers));
        let message = || format!("at most {MOST_NUMBERS} numbers in all accessors that are read");
        budget.0 = left.ok_or_else(|| count.expected(&message()))?;
        let component = Component::of(&item.require("componentType")?)?;
        let count = count.whole()?;
        let run = |view: Option<View>, owner: &Item<'_>, count: usize| {
            let offset = owner.whole_or("byteOffset", 0)?;
            let size = component.size() * width;
            let run = view.map(|view| Run::new(owner, view, offset, size, count));
            run.transpose()
        };
        let view = item.get("bufferView")?;
        let view = view.map(|view| buffers.view(&view)).transpose()?;
        let base = run(view, &item, count)?;
        let sparse = match item.get("sparse")? {
            None => None,
            Some(sparse) => {
                let targets = targets(&sparse, buffers, count)?;
                let values = sparse.require("values")?;
                let view = buffers.view(&values.require("bufferView")?)?;
                let values = run(Some(view), &values, targets.len())?;
                values.map(|values| Sparse { targets, values })
            }
        };
        Ok(Self {
            normalized: item.is_true("normalized")?,
            item,
            count,
            width,
            component,
            base,
            sparse,
        })
    }

    /// Numbers per element.
    pub(super) const fn width(&self) -> usize {
        self.width
    }

    /// All elements as finite numbers.
    pub(super) fn floats<const N: usize>(&self) -> Result<Vec<[f32; N]>, Diagnostic> {
        if self.width != N {
            return Err(self
                .item
                .error(&format!("expected elements of {N} numbers")));
        }
        let mut elements = vec![[0.0; N]; self.count];
        let each: Vec<usize> = match &self.base {
            Some(_) => (0..self.count).collect(),
            None => Vec::new(),
        };
        let runs = [
            self.base.as_ref().map(|base| (base, &each)),
            self.sparse
                .as_ref()
                .map(|sparse| (&sparse.values, &sparse.targets)),
        ];
        for (run, targets) in runs.into_iter().flatten() {
            for (index, &target) in targets.iter().enumerate() {
                let bytes = run.element(index);
                let size = self.component.size();
                for (number, bytes) in elements[target].iter_mut().zip(bytes.chunks_exact(size)) {
                    *number = self.component.number(bytes, self.normalized);
                }
                if !elements[target].iter().all(|number| number.is_finite()) {
                    let message = format!("element {target}: expected finite numbers");
                    return Err(self.item.error(&message));
                }
            }
        }
        Ok(elements)
    }

    /// All elements as indices of `count` vertices.
    pub(super) fn indices(&self, count: usize) -> Result<Vec<u32>, Diagnostic> {
        let kinds = [Component::U8, Component::U16, Component::U32];
        if self.width != 1 || !kinds.contains(&self.component) || self.sparse.is_some() {
            let message = "expected single whole numbers of at least 0";
            return Err(self.item.error(message));
        }
        let run = self.base.as_ref();
        let run = run.ok_or_else(|| self.item.error("expected a member `bufferView`"))?;
        let index = |target: usize| {
            let index = self.component.whole(run.element(target));
            let found = (index as usize) < count;
            let message = || format!("element {target}: vertex {index} of {count} does not exist");
            found
                .then_some(index)
                .ok_or_else(|| self.item.error(&message()))
        };
        (0..self.count).map(index).collect()
    }
}

/// Indices of the elements that a sparse accessor replaces, in ascending order.
fn targets(sparse: &Item<'_>, buffers: &Buffers<'_>, of: usize) -> Result<Vec<usize>, Diagnostic> {
    let count = sparse.require("count")?;
    let message = || format!("at most {of}, the number of elements");
    let number = count.whole()?;
    if number > of {
        return Err(count.expected(&message()));
    }
    let indices = sparse.require("indices")?;
    let component = Component::of(&indices.require("componentType")?)?;
    let view = buffers.view(&indices.require("bufferView")?)?;
    let offset = indices.whole_or("byteOffset", 0)?;
    let run = Run::new(&indices, view, offset, component.size(), number)?;
    let targets: Vec<usize> = (0..number)
        .map(|index| component.whole(run.element(index)) as usize)
        .collect();
    let ascends = targets.windows(2).all(|pair| pair[0] < pair[1]);
    if !ascends || targets.last().is_some_and(|&last| last >= of) {
        let message = format!("expected ascending indices below {of}");
        return Err(indices.error(&message));
    }
    Ok(targets)
}

impl Run {
    /// `count` elements of `size` bytes; an error of `owner` if the view is too short.
    fn new(
        owner: &Item<'_>,
        view: View,
        offset: usize,
        size: usize,
        count: usize,
    ) -> Result<Self, Diagnostic> {
        let stride = view.stride.unwrap_or(size);
        let needed = count.checked_sub(1).map_or(Some(0), |steps| {
            let last = steps.checked_mul(stride)?;
            last.checked_add(size)?.checked_add(offset)
        });
        let (found, whole) = (view.bytes().len(), stride >= size);
        if !whole || needed.is_none_or(|needed| needed > found) {
            let message = format!(
                "expected a view that holds {count} elements of {size} bytes from byte {offset} \
                 on, found {found} bytes"
            );
            return Err(owner.error(&message));
        }
        Ok(Self {
            view,
            offset,
            stride,
        })
    }

    fn element(&self, index: usize) -> &[u8] {
        &self.view.bytes()[self.offset + index * self.stride..]
    }
}

impl Component {
    fn of(item: &Item<'_>) -> Result<Self, Diagnostic> {
        Ok(match item.whole()? {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return Err(item.expected("5120, 5121, 5122, 5123, 5125 or 5126")),
        })
    }

    const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number in the first bytes; a normalised integer is divided by its largest value.
    fn number(self, bytes: &[u8], normalized: bool) -> f32 {
        let (number, largest) = match self {
            Self::I8 => (f32::from(i8::from_le_bytes([bytes[0]])), 127.0),
            Self::U8 => (f32::from(bytes[0]), 255.0),
            Self::I16 => (f32::from(i16::from_le_bytes([bytes[0], bytes[1]])), 32767.0),
            Self::U16 => (f32::from(u16::from_le_bytes([bytes[0], bytes[1]])), 65535.0),
            Self::U32 => (self.whole(bytes) as f32, 4_294_967_295.0),
            Self::F32 => return f32::from_bits(four(bytes)),
        };
        if normalized {
            (number / largest).max(-1.0)
        } else {
            number
        }
    }

    /// The whole number of at least 0 in the first bytes.
    fn whole(self, bytes: &[u8]) -> u32 {
        match self.size() {
            1 => bytes[0].into(),
            2 => u16::from_le_bytes([bytes[0], bytes[1]]).into(),
            _ => four(bytes),
        }
    }
}

fn four(bytes: &[u8]) -> u32 {
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}
