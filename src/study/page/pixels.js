// Pictures: from text to radiance (study/page/picture.rs writes them), from radiance to colours.

const NONFINITE_CODE = 0xffff;
const NONFINITE_COLOUR = [0, 255, 0];

/// Decoded pictures by index, the latest last; an older one is decoded again when it is needed.
const decoded = new Map();
const KEPT = 8;

/// The codes of a picture: RGB, sixteen bits each.
function codesOf(index) {
  const known = decoded.get(index) ?? decode(index);
  decoded.delete(index);
  decoded.set(index, known);
  if (decoded.size > KEPT) decoded.delete(decoded.keys().next().value);
  return known;
}

async function decode(index) {
  if (!("DecompressionStream" in globalThis)) {
    throw new Error("This browser cannot unpack pictures (it lacks DecompressionStream); a newer one can.");
  }
  const text = atob(byId(`picture-${index}`).textContent);
  const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const { width, height } = PICTURES[index];
  if (bytes.length !== 6 * width * height) throw new Error("The picture is damaged.");
  return unfiltered(bytes, width, width * height);
}

/// Undoes the differences of neighbours and of channels.
function unfiltered(bytes, width, size) {
  const [green, red, blue] = [0, 1, 2].map((channel) =>
    plane(bytes.subarray(2 * channel * size), width, size),
  );
  const codes = new Uint16Array(3 * size);
  for (let pixel = 0; pixel < size; pixel += 1) {
    codes[3 * pixel] = red[pixel] + green[pixel];
    codes[3 * pixel + 1] = green[pixel];
    codes[3 * pixel + 2] = blue[pixel] + green[pixel];
  }
  return codes;
}

function plane(bytes, width, size) {
  const values = new Uint16Array(size);
  for (let pixel = 0; pixel < size; pixel += 1) {
    const folded = bytes[pixel] | (bytes[size + pixel] << 8);
    const before = pixel % width ? values[pixel - 1] : pixel ? values[pixel - width] : 0;
    values[pixel] = before + ((folded >> 1) ^ -(folded & 1));
  }
  return values;
}

/// The radiance of every code: the upper half of an f32 without the sign.
const VALUES = new Float32Array(Uint32Array.from({ length: 0x10000 }, (_, code) => code << 15).buffer);

function srgb(linear) {
  const value = Math.min(Math.max(linear, 0), 1);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
}

/// A picture as a screen shows it, at an exposure in stops.
function toned(codes, width, height, exposure) {
  const gain = 2 ** exposure;
  const bytes = Uint8Array.from(VALUES, (value) => Math.round(255 * srgb(gain * value)));
  return painted(width, height, (pixel, put) => {
    const [r, g, b] = [codes[3 * pixel], codes[3 * pixel + 1], codes[3 * pixel + 2]];
    if (r === NONFINITE_CODE || g === NONFINITE_CODE || b === NONFINITE_CODE) put(...NONFINITE_COLOUR);
    else put(bytes[r], bytes[g], bytes[b]);
  });
}

/// A canvas whose pixels are given one by one.
function painted(width, height, paint) {
  const canvas = make("canvas", { width, height });
  const image = new ImageData(width, height);
  let place = 0;
  const put = (r, g, b) => {
    image.data[place] = r;
    image.data[place + 1] = g;
    image.data[place + 2] = b;
    image.data[place + 3] = 255;
    place += 4;
  };
  for (let pixel = 0; pixel < width * height; pixel += 1) paint(pixel, put);
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
}

/// The difference of two codes. Neighbouring codes may stand for the same value, rounded: what
/// is that near is not a difference.
function difference(a, b) {
  return Math.abs(a - b) <= 1 ? 0 : VALUES[a] - VALUES[b];
}

/// A − B a pixel: the root mean square over channels, or with signs their mean.
function differences(a, b, isSigned) {
  const size = a.length / 3;
  const values = new Float32Array(size);
  for (let pixel = 0; pixel < size; pixel += 1) {
    const of = (channel) => difference(a[3 * pixel + channel], b[3 * pixel + channel]);
    const [red, green, blue] = [of(0), of(1), of(2)];
    const squares = red * red + green * green + blue * blue;
    values[pixel] = isSigned ? (red + green + blue) / 3 : Math.sqrt(squares / 3);
  }
  return values;
}

/// What 99 % of the values are within.
function usualSize(values) {
  const sizes = values.map(Math.abs).filter(Number.isFinite).sort();
  const found = sizes[Math.ceil(sizes.length * 0.99) - 1] || sizes.at(-1);
  return found || 1;
}

/// The colour at a place in [0, 1] of a ramp.
function mixed(ramp, place) {
  const within = Math.min(Math.max(place, 0), 1) * (ramp.length - 1);
  const index = Math.min(Math.floor(within), ramp.length - 2);
  const part = within - index;
  return ramp[index].map((from, channel) => Math.round(from + part * (ramp[index + 1][channel] - from)));
}

/// Values in false colours up to a scale.
function mapped(values, width, height, isSigned, scale) {
  const ramp = isSigned ? DATA.diverging : DATA.sequential;
  const colours = Array.from({ length: 1025 }, (_, index) => mixed(ramp, index / 1024));
  return painted(width, height, (pixel, put) => {
    const value = values[pixel] / scale;
    if (!Number.isFinite(value)) return put(...NONFINITE_COLOUR);
    const place = Math.min(Math.max(isSigned ? 0.5 + 0.5 * value : value, 0), 1);
    put(...colours[Math.round(1024 * place)]);
  });
}
