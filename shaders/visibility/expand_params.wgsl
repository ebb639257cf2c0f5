// Parameters and buffers of the stages that bring the visibility of VPL clusters to VPLs.

struct ExpandParams {
    rows: u32,
    matrix_word: u32,
    words: u32,
    pad: u32,
}

@group(0) @binding(0) var<storage, read> params: ExpandParams;
@group(0) @binding(6) var<storage, read_write> bits: array<u32>;
