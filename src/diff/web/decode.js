const data = JSON.parse(byId("data").textContent);
// Pixels as src/diff/packed_samples.h packs them.
async function inflated(text) {
  const raw = atob(text.trim()), bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
// Prediction: 0 by the neighbours, 1 by the same pixel of `base`, 2 by the neighbours' differences to it.
async function unpackedCodes(text, width, height, channels, bits, prediction = 0, base = null) {
  const bytes = await inflated(text);
  const count = width * height * channels, planes = Math.ceil(bits / 8), mask = bits === 32 ? -1 : (1 << bits) - 1;
  if (bytes.length !== count * planes) throw new Error("pixels are cut short");
  const codes = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    let r = bytes[i];
    for (let p = 1; p < planes; ++p) r |= bytes[p * count + i] << (8 * p);
    codes[i] = (r >>> 1) ^ -(r & 1);
  }
  if (prediction !== 1)
    for (let c = 0, i = 0; c < channels; ++c)
      for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x, ++i)
          codes[i] += (x ? codes[i - 1] : 0) + (y ? codes[i - width] : 0) - (x && y ? codes[i - width - 1] : 0);
  for (let i = 0; i < count; ++i) codes[i] = (codes[i] + (prediction ? base[i] : 0)) & mask;
  return codes;
}
function floatsOf(codes, bits) {
  const raw = new Uint32Array(codes.length), shift = 32 - bits;
  for (let i = 0; i < raw.length; ++i) raw[i] = codes[i] << shift;
  return new Float32Array(raw.buffer);
}
function pictureOf(facts, values) {
  const n = facts.w * facts.h;
  return {...facts, planes: facts.ch.map((_, c) => values.subarray(c * n, (c + 1) * n))};
}
// Both pictures and their maps, or null where the page holds none of this pair.
async function picturesOf(index) {
  const facts = data.pairs[index].pic, text = name => { const e = byId(name + index); return e && e.textContent; };
  if (!facts || facts.note !== undefined) return null;
  const {a, b, bits} = facts;
  const codesA = await unpackedCodes(text("a"), a.w, a.h, a.ch.length, bits);
  const codesB = await unpackedCodes(text("b"), b.w, b.h, b.ch.length, bits, facts.b_from, codesA);
  const flip = text("f");
  return {display: facts.display, a: pictureOf(a, floatsOf(codesA, bits)), b: pictureOf(b, floatsOf(codesB, bits)),
    error: await errorsOf(index), flip: flip ? Float32Array.from(await unpackedCodes(flip, a.w, a.h, 1, 8), x => x / 255) : null};
}
async function errorsOf(index) {
  const facts = data.pairs[index].pic, element = byId("e" + index);
  if (!element) return null;
  return floatsOf(await unpackedCodes(element.textContent, facts.a.w, facts.a.h, 1, facts.error_bits), facts.error_bits);
}
// Where a camera looks: azimuth and elevation of a place in pixels of the file, or null.
const grids = [];
async function readCamera(number) {
  const c = data.cameras[number];
  if (!grids[number]) grids[number] = {...c, codes: await unpackedCodes(c.d, c.gw, c.gh, 3, c.bits)};
  return grids[number];
}
function skyAt(grid, x, y) {
  const i = Math.min(Math.max(Math.floor(x / grid.step), 0), grid.gw - 2), j = Math.min(Math.max(Math.floor(y / grid.step), 0), grid.gh - 2);
  const n = grid.gw * grid.gh, fx = x / grid.step - i, fy = y / grid.step - j;
  const corner = (di, dj) => {
    const at = (j + dj) * grid.gw + i + di;
    return grid.codes[at] === 0 ? null : [0, 1, 2].map(c => (grid.codes[c * n + at] - 1) / 32767 - 1);
  };
  const corners = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
  const near = corners[(fx > 0.5 ? 1 : 0) + (fy > 0.5 ? 2 : 0)];
  if (!near) return null;
  // Across the edge of a face nothing lies between two corners: the nearer one.
  const smooth = corners.every(v => v && v[0] * near[0] + v[1] * near[1] + v[2] * near[2] > 0.9);
  const weights = [(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy];
  const v = smooth ? [0, 1, 2].map(c => corners.reduce((sum, k, m) => sum + weights[m] * k[c], 0)) : near;
  const degrees = 180 / Math.PI;
  return {azimuth: (Math.atan2(v[0], v[1]) * degrees + 360) % 360, elevation: Math.atan2(v[2], Math.hypot(v[0], v[1])) * degrees};
}
