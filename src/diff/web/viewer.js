// The viewer: layers that are shaded once for an exposure, drawn as often as the view moves.
const kModes = [["overview", "Overview"], ["wipe", "Wipe"], ["blink", "Blink"], ["relative", "Relative"], ["absolute", "Absolute"], ["flip", "FLIP"]];
const kColoured = ["overview", "relative", "absolute", "flip"];  // with false colours
const canvas = byId("canvas"), stage = byId("stage"), pen = canvas.getContext("2d");
const view = {pair: null, pictures: null, grid: null, mode: "overview", stops: 0, ranges: {}, autoRanges: {}, channel: -1, wipe: 0.5,
  zoom: 0, x: 0, y: 0, cursor: null, blinkB: false, blinking: true, layers: {}, odd: null, number: 0};

function layer(name) {
  if (view.layers[name]) return view.layers[name];
  const p = view.pictures, marks = byId("marks").checked;
  let image;
  if (name === "a" || name === "b") image = shaded(p[name], p.display, view.channel, view.stops, marks);
  else image = falseColours(mapOf(name), p.a.w, p.a.h, rangeOf(name));
  const surface = document.createElement("canvas");
  surface.width = image.width, surface.height = image.height;
  surface.getContext("2d").putImageData(image, 0, 0);
  return view.layers[name] = surface;
}
const mapKey = () => view.mode === "overview" ? "relative" : view.mode;
function mapOf(name) {
  const p = view.pictures;
  if (name === "relative") return p.error;
  if (name === "flip") return p.flip;
  if (!p.difference || p.differenceChannel !== view.channel)
    p.difference = absoluteDifference(p.a, p.b, view.channel), p.differenceChannel = view.channel;
  return p.difference;
}
const sameSize = () => view.pictures.a.w === view.pictures.b.w && view.pictures.a.h === view.pictures.b.h;
const sameChannels = () => view.pictures.a.ch.join() === view.pictures.b.ch.join();
function offered(mode) {
  const p = view.pictures;
  if (mode === "overview") return true;
  if (!sameSize()) return false;
  return mode === "relative" ? p.error !== null : mode === "flip" ? p.flip !== null : mode === "absolute" ? sameChannels() : true;
}
// Where full colour begins: at the limit that fails, else where the largest half percent lies.
function rangeOf(name) {
  return view.ranges[name] || (view.autoRanges[name] = view.autoRanges[name] || autoRange(name));
}
function autoRange(name) {
  const limit = name === "relative" ? failLimit(view.pair, view.pictures.display ? "display.max" : "relative.max") : 0;
  const sizes = sizesOf(mapOf(name)), least = name === "flip" ? 0.1 : view.pictures.display ? 1e-3 : 1e-7;
  return limit > 0 ? limit : Math.max(quantile(sizes, 0.995), sizes.length ? least : 1);
}

// Panels side by side or one above the other, whichever shows more.
function panels() {
  const width = stage.clientWidth, highest = Math.max(220, Math.min(0.68 * innerHeight, 760));
  const p = view.pictures, names = view.mode === "overview" ? ["a", "b"].concat(p.error ? ["relative"] : [], p.flip ? ["flip"] : []) : [view.mode];
  const w = Math.max(p.a.w, p.b.w), h = Math.max(p.a.h, p.b.h);
  let best = null;
  for (let columns = 1; columns <= names.length; ++columns) {
    const rows = Math.ceil(names.length / columns), scale = Math.min(width / columns / w, highest / rows / h);
    // More columns leave room below for what is told of the pair: they may cost a quarter of the size.
    if (!best || scale > best.scale * 0.75) best = {columns, rows, scale};
  }
  const height = Math.max(180, Math.min(highest, Math.round(best.rows * h * width / best.columns / w)));
  const pw = Math.floor(width / best.columns), ph = Math.floor(height / best.rows);
  return {width, height, list: names.map((name, i) => ({name, x: (i % best.columns) * pw, y: Math.floor(i / best.columns) * ph, w: pw - (best.columns > 1 ? 2 : 0), h: ph - (best.rows > 1 ? 2 : 0)}))};
}
const fitZoom = panel => Math.min(panel.w / Math.max(view.pictures.a.w, view.pictures.b.w), panel.h / Math.max(view.pictures.a.h, view.pictures.b.h));
const zoomOf = panel => view.zoom || fitZoom(panel);
const toScreen = (panel, x, y) => [panel.x + panel.w / 2 + (x - view.x) * zoomOf(panel), panel.y + panel.h / 2 + (y - view.y) * zoomOf(panel)];
const kLabels = {a: "A, reference", b: "B, tested", relative: "difference, relative", absolute: "difference B \u2212 A", flip: "FLIP"};

let waiting = false;
function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
}
function draw() {
  if (!view.pictures) return;
  const layout = panels(), ratio = devicePixelRatio || 1;
  if (canvas.width !== Math.round(layout.width * ratio) || canvas.height !== Math.round(layout.height * ratio)) {
    canvas.width = Math.round(layout.width * ratio), canvas.height = Math.round(layout.height * ratio);
    canvas.style.height = layout.height + "px";
  }
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, layout.width, layout.height);
  for (const panel of layout.list) drawPanel(panel);
}
function drawPanel(panel) {
  pen.save();
  pen.beginPath(), pen.rect(panel.x, panel.y, panel.w, panel.h), pen.clip();
  let label = kLabels[panel.name];
  if (panel.name === "wipe") {
    const edge = panel.x + view.wipe * panel.w;
    drawLayer(panel, "a", panel.x, edge), drawLayer(panel, "b", edge, panel.x + panel.w);
    pen.fillStyle = "#fff", pen.fillRect(edge - 1.5, panel.y, 3, panel.h);
    pen.fillStyle = "#000", pen.fillRect(edge - 0.5, panel.y, 1, panel.h);
    pen.beginPath(), pen.arc(edge, panel.y + panel.h / 2, 11, 0, 7), pen.fillStyle = "#fff", pen.fill();
    pen.fillStyle = "#000", pen.textAlign = "center", pen.textBaseline = "middle", pen.font = "13px sans-serif", pen.fillText("\u2194", edge, panel.y + panel.h / 2);
    drawLabel(panel, kLabels.b, true), label = kLabels.a;
  } else if (panel.name === "blink") {
    drawLayer(panel, view.blinkB ? "b" : "a"), label = kLabels[view.blinkB ? "b" : "a"];
  } else {
    drawLayer(panel, panel.name);
  }
  if (byId("marks").checked) drawMarks(panel);
  drawLabel(panel, label, false);
  pen.restore();
}
function drawLayer(panel, name, left = panel.x, right = panel.x + panel.w) {
  const surface = layer(name), zoom = zoomOf(panel), [x, y] = toScreen(panel, 0, 0);
  pen.save();
  pen.beginPath(), pen.rect(left, panel.y, Math.max(0, right - left), panel.h), pen.clip();
  pen.imageSmoothingEnabled = zoom * (devicePixelRatio || 1) < 1;
  pen.imageSmoothingQuality = "high";
  pen.drawImage(surface, x, y, surface.width * zoom, surface.height * zoom);
  pen.restore();
}
function drawLabel(panel, text, right) {
  pen.font = "12px system-ui, sans-serif", pen.textBaseline = "middle", pen.textAlign = "left";
  const width = pen.measureText(text).width + 12, x = right ? panel.x + panel.w - width - 6 : panel.x + 6;
  const y = panel.y + panel.h - 26;  // below: zeniths are above
  pen.fillStyle = "rgba(0,0,0,.62)", pen.fillRect(x, y, width, 20);
  pen.fillStyle = "#fff", pen.fillText(text, x + 6, y + 10);
}
// Two rings, dark in light: to be seen on any sky.
function ring(x, y, radius, colour, dash = []) {
  pen.setLineDash([]), pen.lineWidth = 4, pen.strokeStyle = "rgba(0,0,0,.7)";
  pen.beginPath(), pen.arc(x, y, radius, 0, 7), pen.stroke();
  pen.setLineDash(dash), pen.lineWidth = 2, pen.strokeStyle = colour;
  pen.beginPath(), pen.arc(x, y, radius, 0, 7), pen.stroke(), pen.setLineDash([]);
}
function tag(x, y, text) {
  pen.font = "600 11px system-ui, sans-serif", pen.textAlign = "left", pen.textBaseline = "middle";
  pen.lineWidth = 3, pen.strokeStyle = "rgba(0,0,0,.8)", pen.strokeText(text, x, y), pen.fillStyle = "#fff", pen.fillText(text, x, y);
}
function drawMarks(panel) {
  const zoom = zoomOf(panel), half = Math.max(0, zoom / 2);
  if (view.pictures.sun) {
    const [x, y] = toScreen(panel, ...view.pictures.sun);
    ring(x, y, 16 + half, "#ffe36b", [3, 3]), tag(x + 20 + half, y - 8, "sun");
  }
  const side = panel.name === "a" ? "a" : panel.name === "b" ? "b" : null;
  for (const name of side ? [side] : ["a", "b"])
    if (view.odd[name].places.length <= 40)
      for (const [px, py] of view.odd[name].places) {
        const [x, y] = toScreen(panel, px + 0.5, py + 0.5);
        ring(x, y, 7 + half, "#ff5cff");
      }
  const worst = worstPlace();
  if (worst) {
    const [x, y] = toScreen(panel, worst.x + 0.5, worst.y + 0.5), r = 11 + half;
    ring(x, y, r, "#fff");
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      pen.beginPath(), pen.moveTo(x + dx * r, y + dy * r), pen.lineTo(x + dx * (r + 7), y + dy * (r + 7));
      pen.lineWidth = 4, pen.strokeStyle = "rgba(0,0,0,.7)", pen.stroke(), pen.lineWidth = 2, pen.strokeStyle = "#fff", pen.stroke();
    }
    tag(x + r + 9, y + 10, "worst");
  }
  if (view.cursor && zoom > 3) {
    const [x, y] = toScreen(panel, view.cursor[0], view.cursor[1]);
    pen.lineWidth = 1, pen.strokeStyle = "#000", pen.strokeRect(x - 1, y - 1, zoom + 2, zoom + 2), pen.strokeStyle = "#fff", pen.strokeRect(x, y, zoom, zoom);
  }
}

// What the pixel under the pointer holds in both files.
const kShort = v => v !== v ? "NaN" : v === Infinity ? "Inf" : v === -Infinity ? "-Inf" : v === 0 ? "0" : Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(3) : Number(v.toPrecision(4)).toString();
function showReadout() {
  const p = view.pictures, box = byId("readout");
  if (!p) return;
  if (!view.cursor) return void box.replaceChildren(make("p", {}, "Point at a pixel to read it in both pictures."));
  const [x, y] = view.cursor, k = p.a.k;
  let where = `(${x * k}, ${y * k})` + (k > 1 ? `, mean of ${k} \u00d7 ${k}` : "");
  const sky = view.grid ? skyAt(view.grid, (x + 0.5) * k, (y + 0.5) * k) : null;
  if (sky) where += ` \u00b7 azimuth ${sky.azimuth.toFixed(2)}\u00b0 \u00b7 elevation ${sky.elevation.toFixed(2).replace("-", "\u2212")}\u00b0`;
  const value = (picture, c) => c < picture.planes.length && x < picture.w && y < picture.h ? picture.planes[c][y * picture.w + x] : undefined;
  const shown = v => v === undefined ? "" : p.display ? kShort(255 * v) : kShort(v);
  const change = (a, b) => a === undefined || b === undefined ? "" : Object.is(a, b) || a === b ? "equal"
    : p.display ? (b > a ? "+" : "") + kShort(255 * (b - a)).replace("-", "\u2212")
    : !(Math.abs(a) > 0) || !isFinite(a) || !isFinite(b) ? "\u2260" : signed(100 * (b / a - 1)) + " %";
  const names = p.a.ch.length >= p.b.ch.length ? p.a.ch : p.b.ch;
  const row = (title, f) => make("tr", {}, make("th", {scope: "row"}, title), ...names.map((_, c) => make("td", {}, f(c))));
  const extra = [];
  if (p.error && sameSize()) {
    const e = p.error[y * p.a.w + x];
    extra.push("error " + (Math.abs(e) === Infinity ? "no number" : p.display ? digits(Math.abs(e)) + " code values" : signed(100 * Math.abs(e)).replace("+", "") + " %"));
  }
  if (p.flip) extra.push("FLIP " + p.flip[y * p.a.w + x].toFixed(2));
  box.replaceChildren(make("p", {}, [where, ...extra].join(" \u00b7 ")),
    make("table", {}, make("caption", {class: "hidden"}, "Values of the pixel"), make("thead", {}, make("tr", {}, make("td", {}, p.display ? "8-bit" : ""), ...names.map(n => make("th", {scope: "col"}, n)))),
      make("tbody", {}, row("A", c => shown(value(p.a, c))), row("B", c => shown(value(p.b, c))), row("change", c => change(value(p.a, c), value(p.b, c))))));
}

function worstPlace() {
  const place = view.place, k = view.pictures.a.k;
  return place ? {x: Math.floor(place[0] / k), y: Math.floor(place[1] / k)} : null;
}
// Of every pair anew: the channels there are, automatic exposure and ranges, the whole picture.
async function openViewer(number, place) {
  const pair = data.pairs[number];
  view.number = number, view.pictures = null, view.layers = {}, view.ranges = {}, view.autoRanges = {}, view.cursor = null;
  const pictures = await picturesOf(number);
  const grid = pictures && pair.pic.camera !== undefined ? await readCamera(pair.pic.camera) : null;
  if (view.number !== number || !pictures) return false;
  Object.assign(view, {pair, pictures, grid, place, odd: {a: oddSamples(pictures.a), b: oddSamples(pictures.b)}});
  if (pair.pic.sun) pictures.sun = pair.pic.sun.map(v => v / pictures.a.k);
  const names = pictures.a.ch.length >= pictures.b.ch.length ? pictures.a.ch : pictures.b.ch;
  view.channel = -1;
  byId("channel").replaceChildren(make("option", {value: -1}, pictures.a.colours === 3 ? "colour" : names[0]),
    ...(names.length > 1 ? names.map((n, i) => make("option", {value: i, ...(i < Math.min(pictures.a.ch.length, pictures.b.ch.length) ? {} : {disabled: ""})}, n)) : []));
  if (!offered(view.mode)) view.mode = "overview";
  const auto = autoStops(pictures.a, pictures.display), limit = Math.max(24, Math.ceil(Math.abs(auto)) + 16);
  for (const id of ["exposure", "exposure-number"]) byId(id).min = -limit, byId(id).max = limit;
  byId("viewer").hidden = false;
  const worst = worstPlace();
  view.cursor = worst && worst.x < pictures.a.w && worst.y < pictures.a.h ? [worst.x, worst.y] : null;
  setStops(auto), showNotes(), setMode(view.mode), fit(), showReadout();
  return true;
}
function showNotes() {
  const p = view.pictures, words = o => [[o.nan, "NaN"], [o.infinite, "infinite"], [o.negative, "negative"]].filter(([n]) => n).map(([n, w]) => `${n.toLocaleString("en")} ${w}`).join(", ") || "none";
  const any = ["a", "b"].some(n => view.odd[n].nan + view.odd[n].infinite + view.odd[n].negative > 0);
  const swatch = (c, text) => make("span", {class: "swatch"}, make("i", {style: `background:rgb(${c})`}), text);
  byId("odd").replaceChildren(...(any ? [swatch(kNan, "NaN"), swatch(kInfinite, "infinite"), swatch(kNegative, "negative"), ` samples${p.a.k > 1 ? " (of the shrunk picture)" : ""}: A ${words(view.odd.a)}; B ${words(view.odd.b)}`] : []));
  const notes = [];
  if (!sameSize()) notes.push(`Sizes differ (${p.a.fw} \u00d7 ${p.a.fh} against ${p.b.fw} \u00d7 ${p.b.fh}): there is no difference to show.`);
  else if (!p.error) notes.push("These pictures have no map of errors.");
  if (p.a.k > 1) notes.push(`Shrunk ${p.a.k} times: means of ${p.a.k} \u00d7 ${p.a.k} pixels; maps keep the largest error, NaN and Inf are kept.`);
  if (p.a.left_out || p.b.left_out) notes.push(`Channels beyond the first ${p.a.ch.length} are not in this page.`);
  byId("picture-note").textContent = notes.join(" ");
}
function setStops(stops) {
  const low = Number(byId("exposure").min), high = Number(byId("exposure").max);
  view.stops = Math.min(high, Math.max(low, stops));
  byId("exposure").value = byId("exposure-number").value = view.stops;
  byId("exposure-text").textContent = (view.stops > 0 ? "+" : view.stops < 0 ? "\u2212" : "") + Math.abs(view.stops) + " stops";
  delete view.layers.a, delete view.layers.b;
  redraw();
}
const rangeWords = (name, v) => name === "relative" ? (view.pictures.display ? digits(v) + " code values" : digits(100 * v, 3) + " %") : kShort(v);
function setRange(value) {
  const name = mapKey();
  if (value) view.ranges[name] = value;
  if (!kColoured.includes(view.mode) || (name === "relative" && !view.pictures.error)) return;
  const now = rangeOf(name), middle = Math.round(16 * Math.log10(view.autoRanges[name] || now)) / 4;
  byId("range").min = Math.min(middle - 16, 4 * Math.log10(now)), byId("range").max = Math.max(middle + 16, 4 * Math.log10(now));
  byId("range").value = 4 * Math.log10(now);
  byId("range-text").textContent = rangeWords(name, now);
  delete view.layers[name];
  redraw();
}
function setMode(mode) {
  if (!offered(mode)) return;
  if (mode === "blink" && view.mode !== mode) view.blinking = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  view.mode = mode;
  for (const b of byId("modes").children) b.setAttribute("aria-pressed", String(b.dataset.mode === mode)), b.disabled = !offered(b.dataset.mode);
  byId("wipe-box").hidden = mode !== "wipe";
  byId("range-box").hidden = !kColoured.includes(mode) || (mapKey() === "relative" && !view.pictures.error);
  byId("exposure-box").hidden = kColoured.includes(mode) && mode !== "overview";
  byId("legend").classList.toggle("positive", mode === "flip");
  for (const [i, text] of (mode === "flip" ? ["equal", "", "unlike"] : ["B darker", "equal", "B brighter"]).entries()) document.querySelectorAll(".legend-text span")[i].textContent = text;
  setRange(0);
  redraw();
}
function fit() {
  view.zoom = 0, view.x = Math.max(view.pictures.a.w, view.pictures.b.w) / 2, view.y = Math.max(view.pictures.a.h, view.pictures.b.h) / 2;
  redraw();
}
function zoomTo(zoom, x = view.x, y = view.y) {
  view.zoom = Math.min(64, Math.max(fitZoom(panels().list[0]) / 2, zoom)), view.x = x, view.y = y;
  redraw();
}
const zoomNow = () => zoomOf(panels().list[0]);
function toWorst(place = view.place) {
  if (!view.pictures || !place) return;
  view.place = place;
  const at = worstPlace();
  view.cursor = [at.x, at.y];
  zoomTo(Math.max(8, zoomNow()), at.x + 0.5, at.y + 0.5), showReadout();
}
function moveCursor(dx, dy) {
  const p = view.pictures, from = view.cursor || [Math.floor(view.x), Math.floor(view.y)];
  view.cursor = [Math.min(p.a.w - 1, Math.max(0, from[0] + dx)), Math.min(p.a.h - 1, Math.max(0, from[1] + dy))];
  showReadout(), redraw();
}
