//! Textures that hold tables. Mesa's llvmpipe loads from a storage buffer lane by lane, and waits
//! for each; from a texture it loads all lanes at once.

use bytemuck::Pod;

use super::{Gpu, GpuError};

/// Texels in a row of a table, but where one row is enough; `table_place` in
/// `shaders/common/table.wgsl` knows it. Every adapter has so many.
const TABLE_WIDTH: usize = 8192;
/// Bytes of a texel.
const TEXEL: usize = 16;

/// A table in a texture, and the name by which shaders know it.
#[derive(Debug, Clone)]
pub struct Texture {
    /// As in the shaders.
    pub name: &'static str,
    /// Bytes that it takes.
    pub bytes: u64,
    pub(super) view: wgpu::TextureView,
}

/// How many words of 32 bits a texel of a table has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TableFormat {
    /// Two.
    Pairs,
    /// Four.
    Quadruples,
}

impl TableFormat {
    /// Bytes of a texel.
    fn texel(self) -> usize {
        match self {
            Self::Pairs => TEXEL / 2,
            Self::Quadruples => TEXEL,
        }
    }
}

impl Texture {
    /// What a table of so many elements of `T` takes, in bytes.
    pub fn bytes_of<T>(count: usize) -> u64 {
        let [width, height] = size_of_table(count * size_of::<T>());
        (TEXEL * width * height) as u64
    }
}

/// Columns and rows of a table of so many bytes.
fn size_of_table(bytes: usize) -> [usize; 2] {
    let texels = bytes.div_ceil(TEXEL).max(1);
    let width = texels.min(TABLE_WIDTH);
    [width, texels.div_ceil(width)]
}

impl Gpu {
    /// A texture that holds `data`, 16 bytes a texel, row by row.
    ///
    /// # Errors
    /// It has more rows than the adapter has, or memory is out.
    pub fn texture_of<T: Pod>(&self, name: &'static str, data: &[T]) -> Result<Texture, GpuError> {
        let mut bytes = bytemuck::cast_slice::<T, u8>(data).to_vec();
        let size = size_of_table(bytes.len());
        bytes.resize(TEXEL * size[0] * size[1], 0);
        self.create_table(name, size, TableFormat::Quadruples, &bytes, wgpu::TextureUsages::empty())
    }

    /// A table of `texels` texels of 0 that kernels write and later ones read.
    ///
    /// # Errors
    /// It has more rows than the adapter has, or memory is out.
    pub fn table(
        &self,
        name: &'static str,
        texels: usize,
        format: TableFormat,
    ) -> Result<Texture, GpuError> {
        let size = size_of_table(TEXEL * texels);
        // If zeros are not written, wgpu clears the texture when it is first used; then llvmpipe's
        // timestamps are wrong from there on, as it draws to clear and times what it draws.
        let zeros = vec![0; format.texel() * size[0] * size[1]];
        self.create_table(name, size, format, &zeros, wgpu::TextureUsages::STORAGE_BINDING)
    }

    fn create_table(
        &self,
        name: &'static str,
        [width, height]: [usize; 2],
        format: TableFormat,
        bytes: &[u8],
        usage: wgpu::TextureUsages,
    ) -> Result<Texture, GpuError> {
        let size =
            wgpu::Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 };
        let texture = self.checked(&format!("allocating {name}"), || {
            let texture = self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(name),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: match format {
                    TableFormat::Pairs => wgpu::TextureFormat::Rg32Uint,
                    TableFormat::Quadruples => wgpu::TextureFormat::Rgba32Uint,
                },
                usage: usage | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            });
            let layout = wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some((format.texel() * width) as u32),
                rows_per_image: None,
            };
            self.queue.write_texture(texture.as_image_copy(), bytes, layout, size);
            texture
        })?;
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Ok(Texture { name, bytes: bytes.len() as u64, view })
    }
}
