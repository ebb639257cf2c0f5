// Logarithmic axes: the same rules as those of the static plots (plot/axis.rs).

const NARROWEST = Math.log(8);
const MARGIN = Math.log(1.25);

/// An axis around all these values, what is not positive left aside.
function logAxis(values, from, to) {
  const logarithms = values.filter((value) => isNumber(value) && value > 1e-300).map(Math.log);
  let low = Math.min(...logarithms);
  let high = Math.max(...logarithms);
  if (!logarithms.length) [low, high] = [Math.log(0.1), 0];
  const margin = Math.max((NARROWEST - (high - low)) / 2, MARGIN);
  return { low: low - margin, high: high + margin, from, to };
}

/// Where a value lies; at the nearer end where it lies outside, zero included.
function at(axis, value) {
  return Math.min(Math.max(beyond(axis, value), Math.min(axis.from, axis.to)), Math.max(axis.from, axis.to));
}

/// Where a value lies, be it outside: for lines that are clipped.
function beyond(axis, value) {
  const part = (Math.log(Math.max(value, 1e-300)) - axis.low) / (axis.high - axis.low);
  return axis.from + part * (axis.to - axis.from);
}

/// Whether a value lies below the axis.
function isBelow(axis, value) {
  return !(value > 0) || Math.log(value) < axis.low;
}

/// Lines at 1 to 9 of every decade; labels at 1, 2 and 5 where there are few decades.
function ticks(axis) {
  const [low, high] = [axis.low, axis.high].map((value) => value / Math.LN10);
  const every = Math.max(1, Math.ceil((high - low) / 8));
  const all = [];
  for (let decade = Math.floor(low); decade <= high; decade += 1) {
    for (let digit = 1; digit < 10; digit += 1) {
      const place = decade + Math.log10(digit);
      if (place < low || place > high) continue;
      const fine = high - low <= 2.5 && (digit === 1 || digit === 2 || digit === 5);
      const labelled = fine || (digit === 1 && decade % every === 0);
      const value = Number(`${digit}e${decade}`);
      all.push({ value, label: labelled ? tickLabel(digit, decade) : null });
    }
  }
  return all;
}

function tickLabel(digit, decade) {
  if (decade < 0 && decade >= -4) return `0.${"0".repeat(-decade - 1)}${digit}`;
  if (decade >= 0 && decade < 5) return `${digit}${"0".repeat(decade)}`;
  return digit === 1 ? `10${raised(decade)}` : `${digit}·10${raised(decade)}`;
}

/// What a mean and its deviation take on an axis: a bar to zero does not stretch it.
function extent({ mean, sd }) {
  const deviation = isNumber(sd) ? sd : 0;
  return [mean, mean + deviation, Math.max(mean - deviation, mean / 2)];
}
