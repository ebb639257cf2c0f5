// Which of eight lights a point sees.

@group(0) @binding(21) var<storage, read> signatures: array<u32>;

fn signature_of(point: u32) -> u32 {
    return signatures[point];
}
