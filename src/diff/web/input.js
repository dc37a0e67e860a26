// Mouse, touch and keys on the viewer.
byId("modes").append(...kModes.map(([mode, title], i) => make("button",
  {type: "button", "data-mode": mode, "aria-pressed": "false", title: "key " + (i + 1), on: {click: () => setMode(mode)}}, title)));
byId("exposure").addEventListener("input", e => setStops(Number(e.target.value)));
byId("exposure-number").addEventListener("change", e => setStops(Number(e.target.value) || 0));
byId("auto").addEventListener("click", () => setStops(autoStops(view.pictures.a, view.pictures.display)));
byId("range").addEventListener("input", e => setRange(Math.pow(10, e.target.value / 4)));
byId("range-auto").addEventListener("click", () => { delete view.ranges[mapKey()]; setRange(0); });
byId("wipe").addEventListener("input", e => { view.wipe = e.target.value / 100; redraw(); });
byId("channel").addEventListener("input", e => { view.channel = Number(e.target.value); view.layers = {}; delete view.autoRanges.absolute; setRange(0); redraw(); });
byId("marks").addEventListener("input", () => { view.layers = {}; redraw(); });
byId("fit").addEventListener("click", fit);
byId("one").addEventListener("click", () => zoomTo(1 / (devicePixelRatio || 1)));
byId("worst").addEventListener("click", () => toWorst());
byId("plus").addEventListener("click", () => zoomTo(zoomNow() * 1.5));
byId("minus").addEventListener("click", () => zoomTo(zoomNow() / 1.5));
addEventListener("resize", redraw);
setInterval(() => { if (view.mode === "blink" && view.blinking && view.pictures) view.blinkB = !view.blinkB, redraw(); }, 700);

const panelAt = e => {
  const box = canvas.getBoundingClientRect(), x = e.clientX - box.left, y = e.clientY - box.top;
  const panel = panels().list.find(p => x >= p.x && x < p.x + p.w && y >= p.y && y < p.y + p.h);
  if (!panel) return null;
  const zoom = zoomOf(panel);
  return {panel, screenX: x, px: view.x + (x - panel.x - panel.w / 2) / zoom, py: view.y + (y - panel.y - panel.h / 2) / zoom};
};
function readAt(e) {
  const at = view.pictures && panelAt(e);
  if (!at) return;
  const x = Math.floor(at.px), y = Math.floor(at.py), p = view.pictures;
  if (x < 0 || y < 0 || x >= Math.max(p.a.w, p.b.w) || y >= Math.max(p.a.h, p.b.h)) return;
  view.cursor = [x, y];
  showReadout();
  if (zoomNow() > 3) redraw();
}
// One pointer moves the picture (or the wipe's edge), two zoom.
const pointers = new Map();
let wiping = false;
stage.addEventListener("pointerdown", e => {
  const at = view.pictures && panelAt(e);
  if (!at) return;
  stage.setPointerCapture(e.pointerId);
  pointers.set(e.pointerId, [e.clientX, e.clientY]);
  wiping = view.mode === "wipe" && Math.abs(at.screenX - at.panel.x - view.wipe * at.panel.w) < 24;
  readAt(e);
});
stage.addEventListener("pointermove", e => {
  const before = pointers.get(e.pointerId);
  if (!before) return readAt(e);
  const other = [...pointers].find(([id]) => id !== e.pointerId);
  pointers.set(e.pointerId, [e.clientX, e.clientY]);
  if (other) {
    const distance = p => Math.hypot(p[0] - other[1][0], p[1] - other[1][1]);
    return zoomTo(zoomNow() * distance([e.clientX, e.clientY]) / Math.max(1, distance(before)));
  }
  if (wiping) {
    const panel = panels().list[0], box = canvas.getBoundingClientRect();
    view.wipe = Math.min(1, Math.max(0, (e.clientX - box.left - panel.x) / panel.w));
    byId("wipe").value = 100 * view.wipe;
    return redraw();
  }
  const zoom = zoomNow();
  view.zoom = zoom, view.x -= (e.clientX - before[0]) / zoom, view.y -= (e.clientY - before[1]) / zoom;
  redraw();
});
for (const name of ["pointerup", "pointercancel"]) stage.addEventListener(name, e => pointers.delete(e.pointerId));
// The wheel scrolls the page until the picture has been chosen.
stage.addEventListener("wheel", e => {
  if (!view.pictures || (document.activeElement !== stage && !e.ctrlKey)) return;
  const at = panelAt(e);
  if (!at) return;
  e.preventDefault();
  const zoom = zoomOf(at.panel), next = Math.min(64, Math.max(fitZoom(at.panel) / 2, zoom * Math.pow(1.0015, -e.deltaY)));
  zoomTo(next, at.px + (view.x - at.px) * zoom / next, at.py + (view.y - at.py) * zoom / next);
}, {passive: false});
stage.addEventListener("keydown", e => {
  const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[e.key];
  if (!step || !view.pictures) return;
  e.preventDefault();
  if (e.shiftKey) return moveCursor(...step);
  const zoom = zoomNow();
  zoomTo(zoom, view.x + step[0] * 40 / zoom, view.y + step[1] * 40 / zoom);
});
const kKeys = {"[": () => setStops(view.stops - 0.5), "]": () => setStops(view.stops + 0.5), "0": () => byId("auto").click(),
  f: fit, o: () => byId("one").click(), w: () => toWorst(), "+": () => byId("plus").click(), "=": () => byId("plus").click(), "-": () => byId("minus").click(),
  "<": () => setRange(rangeOf(mapKey()) / 1.5), ">": () => setRange(rangeOf(mapKey()) * 1.5), m: () => byId("marks").click()};
document.addEventListener("keydown", e => {
  if (e.ctrlKey || e.metaKey || e.altKey || e.target.matches("select, input:not([type=range]):not([type=checkbox])")) return;
  const key = e.key.length === 1 ? e.key.toLowerCase() : e.key;
  if (key === "?") return toggleHelp();
  if (key === "j" || key === "k") return step(key === "j" ? 1 : -1);
  if (!view.pictures) return;
  if (key >= "1" && key <= "6") return setMode(kModes[key - 1][0]);
  if (key === " " && view.mode === "blink" && !e.target.matches("button, a, summary, input")) {
    e.preventDefault(), view.blinking = false, view.blinkB = !view.blinkB;
    return redraw();
  }
  if (kKeys[key]) kKeys[key]();
});
