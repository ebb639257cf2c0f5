// Which visible points give their light to the first rays of a pixel: a byte each, the place in the
// 3 x 3 pixels around.

// Nothing is seen that reflects.
const NO_LIGHT = 15u;
// All have the light of the pixel itself.
const ALL_OWN = 0x04040404u;
// That is not so, and nothing else is known yet.
const NOT_LINKED = 0xffffffffu;

fn code_of(codes: u32, ray: u32) -> u32 {
    return (codes >> (8u * ray)) & 255u;
}
