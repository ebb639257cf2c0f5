//! Typed views of the buffers. An accessor is checked as a whole when it is opened, and read
//! an element at a time: what its header claims is never allocated.

use std::collections::HashMap;

use glam::DVec3;

use super::json;
use super::source::Source;
use crate::scene::SceneError;

/// The most elements of an accessor that no buffer backs: there is no data to show that
/// they are meant.
const MOST_WITHOUT_DATA: usize = 1 << 20;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn new(code: u32) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    fn is_index(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }

    /// The number in the first bytes, and what stands for 1 if it is normalised.
    fn read(self, bytes: &[u8]) -> Option<(f64, f64)> {
        Some(match self {
            Self::I8 => (i8::from_le_bytes(*bytes.first_chunk()?).into(), i8::MAX.into()),
            Self::U8 => (u8::from_le_bytes(*bytes.first_chunk()?).into(), u8::MAX.into()),
            Self::I16 => (i16::from_le_bytes(*bytes.first_chunk()?).into(), i16::MAX.into()),
            Self::U16 => (u16::from_le_bytes(*bytes.first_chunk()?).into(), u16::MAX.into()),
            Self::U32 => (u32::from_le_bytes(*bytes.first_chunk()?).into(), u32::MAX.into()),
            Self::F32 => (f32::from_le_bytes(*bytes.first_chunk()?).into(), 1.0),
        })
    }
}

/// Elements at equal distances.
#[derive(Debug, Clone, Copy)]
struct Strided<'a> {
    bytes: &'a [u8],
    stride: usize,
}

/// An accessor whose elements all lie within its buffers.
#[derive(Debug)]
pub struct Accessor<'a> {
    source: &'a Source,
    index: usize,
    pub count: usize,
    component: Component,
    normalized: bool,
    /// Components of an element.
    width: usize,
    /// Without it all elements are 0.
    elements: Option<Strided<'a>>,
    /// Elements that are replaced, and where in `replacements` by what.
    replaced: HashMap<usize, usize>,
    replacements: Option<Strided<'a>>,
}

impl<'a> Accessor<'a> {
    /// Positions.
    pub fn positions(source: &'a Source, index: usize) -> Result<Self, SceneError> {
        Self::open(source, index, &["VEC3"])
    }

    /// Colours, with or without alpha. Those of whole numbers are normalised, whether they say so or
    /// not.
    pub fn colours(source: &'a Source, index: usize) -> Result<Self, SceneError> {
        let mut accessor = Self::open(source, index, &["VEC3", "VEC4"])?;
        accessor.normalized |= accessor.component.is_index();
        Ok(accessor)
    }

    /// Texture coordinates.
    pub fn coordinates(source: &'a Source, index: usize) -> Result<Self, SceneError> {
        Self::open(source, index, &["VEC2"])
    }

    /// Indices of vertices.
    pub fn indices(source: &'a Source, index: usize) -> Result<Self, SceneError> {
        let accessor = Self::open(source, index, &["SCALAR"])?;
        if !accessor.component.is_index() || accessor.normalized {
            return Err(accessor.fault("has indices that are no unsigned integers"));
        }
        Ok(accessor)
    }

    fn open(source: &'a Source, index: usize, kinds: &[&str]) -> Result<Self, SceneError> {
        let fault =
            |what: String| source.fault(format!("accessor {index} {what}; export it again"));
        let json = source.item(&source.document.accessors, "accessor", index)?;
        let Some(component) = Component::new(json.component_type) else {
            return Err(fault(format!(
                "has components of the unknown type {}",
                json.component_type
            )));
        };
        if !kinds.contains(&json.kind.as_str()) {
            return Err(fault(format!("is of type {:?}, not {}", json.kind, kinds.join(" or "))));
        }
        if json.normalized && component == Component::F32 {
            return Err(fault("has floats that it calls normalised".to_owned()));
        }
        let width = match json.kind.as_str() {
            "VEC4" => 4,
            "VEC3" => 3,
            "VEC2" => 2,
            _ => 1,
        };
        let mut accessor = Self {
            source,
            index,
            count: json.count,
            component,
            normalized: json.normalized,
            width,
            elements: None,
            replaced: HashMap::new(),
            replacements: None,
        };
        let size = width * component.size();
        match json.buffer_view {
            Some(view) => {
                let elements = accessor.strided(view, json.byte_offset, json.count, size)?;
                accessor.elements = Some(elements);
            }
            None if json.count > MOST_WITHOUT_DATA => {
                return Err(fault(format!("has {} elements, but no buffer view", json.count)));
            }
            None => {}
        }
        if let Some(sparse) = &json.sparse {
            accessor.replace(sparse, size)?;
        }
        Ok(accessor)
    }

    /// Notes the elements that a sparse accessor replaces.
    fn replace(&mut self, sparse: &json::Sparse, size: usize) -> Result<(), SceneError> {
        let json::Sparse { count, indices, values } = sparse;
        let component = indices.component_type.and_then(Component::new);
        let Some(component) = component.filter(|component| component.is_index()) else {
            return Err(self.fault("has sparse indices that are no unsigned integers"));
        };
        let at =
            self.strided(indices.buffer_view, indices.byte_offset, *count, component.size())?;
        self.replacements =
            Some(self.strided(values.buffer_view, values.byte_offset, *count, size)?);
        for which in 0..*count {
            let bytes = at.bytes.get(which * at.stride..).unwrap_or_default();
            let element = component.read(bytes).map_or(usize::MAX, |(number, _)| number as usize);
            if element >= self.count {
                return Err(self.fault("replaces elements that are not there"));
            }
            self.replaced.insert(element, which);
        }
        Ok(())
    }

    /// So many elements of a view; they are all within it.
    fn strided(
        &self,
        view: usize,
        offset: usize,
        count: usize,
        size: usize,
    ) -> Result<Strided<'a>, SceneError> {
        let (bytes, stride) = self.source.view(view)?;
        let stride = stride.filter(|&stride| stride != 0).unwrap_or(size);
        if stride < size {
            return Err(self.fault(&format!("has elements of {size} bytes every {stride} bytes")));
        }
        let last = |count: usize| (count - 1).checked_mul(stride)?.checked_add(size);
        let length = if count == 0 { Some(0) } else { last(count) };
        let bytes = bytes.get(offset..).filter(|bytes| length.is_some_and(|l| l <= bytes.len()));
        let bytes = bytes.ok_or_else(|| self.fault(&format!("goes beyond buffer view {view}")))?;
        Ok(Strided { bytes, stride })
    }

    fn fault(&self, what: &str) -> SceneError {
        self.source.fault(format!("accessor {} {what}; export it again", self.index))
    }

    /// The vertex an index names.
    pub fn index(&self, element: usize) -> Result<usize, SceneError> {
        self.numbers(element).map(|[number, ..]| number as usize)
    }

    /// An element of finite numbers; what it lacks of three is 0.
    pub fn vector(&self, element: usize) -> Result<DVec3, SceneError> {
        let [x, y, z, _] = self.numbers(element)?;
        let vector = DVec3::new(x, y, z);
        match vector.is_finite() {
            true => Ok(vector),
            false => Err(self.fault(&format!("has an element {element} that is not finite"))),
        }
    }

    /// The last of four components of an element; 1 if it has fewer.
    pub fn alpha(&self, element: usize) -> Result<f64, SceneError> {
        let [.., alpha] = self.numbers(element)?;
        Ok(if self.width == 4 { alpha } else { 1.0 })
    }

    /// The components of an element, and zeros.
    fn numbers(&self, element: usize) -> Result<[f64; 4], SceneError> {
        if element >= self.count {
            let what = format!("has {} elements, but {element} is asked for", self.count);
            return Err(self.fault(&what));
        }
        let (strided, at) = match self.replaced.get(&element) {
            Some(&which) => (self.replacements, which),
            None => (self.elements, element),
        };
        let mut numbers = [0.0; 4];
        let Some(Strided { bytes, stride }) = strided else { return Ok(numbers) };
        let size = self.component.size();
        for (i, number) in numbers.iter_mut().take(self.width).enumerate() {
            let bytes = bytes.get(at * stride + i * size..).unwrap_or_default();
            let read = self.component.read(bytes);
            let (value, one) = read.ok_or_else(|| self.fault("goes beyond its buffer view"))?;
            *number = if self.normalized { (value / one).max(-1.0) } else { value };
        }
        Ok(numbers)
    }
}
