// Numbers for people.

const NOTHING = "–";

function isNumber(value) {
  return typeof value === "number" && Number.isFinite(value);
}

function raised(exponent) {
  return [...String(exponent)].map((c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c])).join("");
}

/// A number with so many decimals, and a minus that is one.
function fixed(value, decimals) {
  return value.toFixed(decimals).replace("-", "−");
}

/// The decimals that leave so many digits that count.
function decimals(value, digits) {
  const size = Math.floor(Math.log10(Math.abs(value)));
  return Math.min(Math.max(digits - 1 - size, 0), 12);
}

/// A number with so many digits that count.
function number(value, digits = 3) {
  if (!isNumber(value)) return NOTHING;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 1e5) return fixed(value, decimals(value, digits));
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${mantissa.replace("-", "−")}·10${raised(Number(exponent))}`;
}

/// A whole number in groups of three.
function count(value) {
  return isNumber(value) ? value.toLocaleString("en").replaceAll(",", "\u202f") : NOTHING;
}

/// What a mean deviates by, to as many decimals; null where that is not known.
function deviation({ mean, sd }, digits) {
  if (!isNumber(sd)) return null;
  const size = Math.abs(mean);
  const isPlain = size >= 1e-4 && size < 1e5;
  return isPlain ? fixed(sd, decimals(mean, digits)) : number(sd, 2);
}

/// A mean and what it deviates by, as text.
function spreadText(spread, digits = 3) {
  if (!spread || !isNumber(spread.mean)) return NOTHING;
  const sd = deviation(spread, digits);
  return sd === null ? number(spread.mean, digits) : `${number(spread.mean, digits)} ± ${sd}`;
}

/// The same with the deviation in quiet.
function spreadCell(spread, digits = 3) {
  const [mean, sd] = spreadText(spread, digits).split(" ± ");
  return sd ? [mean, make("span", { class: "sd" }, ` ± ${sd}`)] : [mean];
}

function signed(value, digits) {
  const text = number(value, digits);
  return isNumber(value) && value > 0 ? `+${text}` : text;
}

function plural(count, what) {
  return `${count} ${what}${count === 1 ? "" : "s"}`;
}
