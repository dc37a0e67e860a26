// From numbers to colours: exposure, the sRGB curve, false colours, and what is no number.
const kNan = [255, 0, 255], kInfinite = [0, 255, 255], kNegative = [255, 225, 0];
const kNegativeShare = 1e-3;  // of the pixel's strongest channel: what counts as negative
const kSteps = 65535;
const encode = x => x <= 0.0031308 ? 12.92 * x : 1.055 * Math.pow(x, 1 / 2.4) - 0.055;
const linearise = x => x <= 0.04045 ? x / 12.92 : Math.pow((x + 0.055) / 1.055, 2.4);
const encoded = new Uint8Array(kSteps + 1), linear = new Float32Array(kSteps + 1);
for (let i = 0; i <= kSteps; ++i) {
  encoded[i] = Math.round(255 * encode(i / kSteps));
  linear[i] = linearise(i / kSteps);
}
const planesShown = (picture, channel) => channel >= 0 ? [channel, channel, channel] : picture.colours === 3 ? [0, 1, 2] : [0, 0, 0];

// 0: a number to look at; else which colour of the highlight it takes.
function oddness(r, g, b) {
  if (r !== r || g !== g || b !== b) return kNan;
  const strongest = Math.max(Math.abs(r), Math.abs(g), Math.abs(b));
  if (strongest === Infinity) return kInfinite;
  return Math.min(r, g, b) < -kNegativeShare * strongest ? kNegative : null;
}
function shaded(picture, display, channel, stops, highlight) {
  const image = new ImageData(picture.w, picture.h), out = image.data, gain = Math.pow(2, stops) * kSteps;
  const [R, G, B] = planesShown(picture, channel).map(c => picture.planes[c]);
  const level = display
    ? v => v > 0 ? encoded[Math.min(kSteps, linear[Math.min(kSteps, v * kSteps) | 0] * gain) | 0] : 0
    : v => v > 0 ? encoded[Math.min(kSteps, v * gain) | 0] : 0;
  for (let i = 0, o = 0; i < R.length; ++i, o += 4) {
    const odd = highlight ? oddness(R[i], G[i], B[i]) : null;
    if (odd) [out[o], out[o + 1], out[o + 2]] = odd;
    else out[o] = level(R[i]), out[o + 1] = level(G[i]), out[o + 2] = level(B[i]);
    out[o + 3] = 255;
  }
  return image;
}
// The middle of the light at 30 % of white, and all but the brightest thirtieth of the picture below white.
function autoStops(picture, display) {
  if (display) return 0;
  const colours = picture.planes.slice(0, picture.colours), values = [], step = Math.max(1, Math.floor(picture.w * picture.h / 20000));
  for (let i = 0; i < picture.w * picture.h; i += step) {
    const v = Math.max(...colours.map(p => p[i]));
    if (v > 0 && v < Infinity) values.push(v);
  }
  if (!values.length) return 0;
  values.sort((x, y) => x - y);
  const at = share => values[Math.floor(share * (values.length - 1))];
  return Math.round(4 * Math.min(Math.log2(0.3 / at(0.5)), Math.log2(1 / at(0.97)))) / 4;
}
// False colours: blue where B is darker, orange where it is brighter, black where they agree.
const kCold = [[0, 0, 0], [12, 56, 120], [58, 140, 222], [214, 238, 255]], kWarm = [[0, 0, 0], [120, 50, 6], [236, 138, 40], [255, 240, 208]];
function ramp(stops, t) {
  const x = Math.min(Math.max(t, 0), 1) * (stops.length - 1), i = Math.min(Math.floor(x), stops.length - 2);
  return stops[i].map((c, k) => Math.round(c + (x - i) * (stops[i + 1][k] - c)));
}
const kRamp = 512, cold = [], warm = [];
for (let i = 0; i <= kRamp; ++i) cold.push(ramp(kCold, i / kRamp)), warm.push(ramp(kWarm, i / kRamp));
function falseColours(values, width, height, range) {
  const image = new ImageData(width, height), out = image.data;
  for (let i = 0, o = 0; i < values.length; ++i, o += 4) {
    const v = values[i];
    const colour = v !== v ? kNan : Math.abs(v) === Infinity ? kInfinite
      : (v < 0 ? cold : warm)[Math.min(kRamp, Math.abs(v) / range * kRamp) | 0];
    out[o] = colour[0], out[o + 1] = colour[1], out[o + 2] = colour[2], out[o + 3] = 255;
  }
  return image;
}
// Per pixel the difference b - a of the channel where it is largest.
function absoluteDifference(a, b, channel) {
  const planes = channel >= 0 ? [channel] : a.planes.map((_, c) => c), out = new Float32Array(a.w * a.h);
  for (let i = 0; i < out.length; ++i)
    for (const c of planes) {
      const x = a.planes[c][i], y = b.planes[c][i];
      const d = x === y || (x !== x && y !== y) ? 0 : y - x;
      if (d !== d || Math.abs(d) > Math.abs(out[i])) out[i] = d;
      if (d !== d) break;
    }
  return out;
}
const sizesOf = values => Float32Array.from(values, Math.abs).filter(x => x > 0 && x < Infinity).sort();
const quantile = (sorted, share) => sorted.length ? sorted[Math.floor(share * (sorted.length - 1))] : 0;
// How many samples are no numbers or negative, and where: at most one place in each cell of 16 x 16.
function oddSamples(picture) {
  const found = {nan: 0, infinite: 0, negative: 0, places: []}, cells = new Set();
  for (let i = 0; i < picture.w * picture.h; ++i) {
    let strongest = 0, odd = false;
    for (let c = 0; c < picture.colours; ++c) {
      const size = Math.abs(picture.planes[c][i]);
      if (size < Infinity && size > strongest) strongest = size;
    }
    for (const plane of picture.planes) {
      const v = plane[i];
      if (v !== v) ++found.nan, odd = true;
      else if (v === Infinity || v === -Infinity) ++found.infinite, odd = true;
      else if (v < -kNegativeShare * strongest) ++found.negative, odd = true;
    }
    if (!odd) continue;
    const x = i % picture.w, y = Math.floor(i / picture.w), cell = (x >> 4) + "," + (y >> 4);
    if (cells.size < 500 && !cells.has(cell)) cells.add(cell), found.places.push([x, y]);
  }
  return found;
}
