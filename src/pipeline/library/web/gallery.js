(() => {
const data = JSON.parse(byId("data").textContent);
const skies = data.skies;
const kPage = 120;  // cards that are made at a time

// A path in the library as a link from this page.
const link = path => path.split("/").map(encodeURIComponent).join("/");
const absolute = path => location.protocol === "file:"
  ? decodeURIComponent(new URL(link(path), location.href).pathname) : new URL(link(path), location.href).href;
const degrees = x => (Math.abs(x) < 0.05 ? 0 : x).toFixed(1).replace("-", "\u2212") + "\u00b0";
const lux = x => x === null ? "" : x === 0 ? "0 lux" : x >= 1000 ? digits(x / 1000, 3) + " klux" : digits(x, 3) + " lux";
const bytes = n => n < 1e3 ? n + " B" : n < 1e6 ? digits(n / 1e3, 3) + " kB" : n < 1e9 ? digits(n / 1e6, 3) + " MB" : digits(n / 1e9, 3) + " GB";
const clock = (s, zone) => s.local.slice(0, 16).replace("T", " ") + (zone ? " UTC" + s.local.slice(19).replace(/^.*?(?=[+-])/, "") : "");
// Of a map without disc: from its sky alone.
const errorOf = f => f.error !== undefined ? f.error / 100 : f.has === undefined || !f.true ? null : f.has / f.true - 1;
const percent = x => (x < 0 ? "\u2212" : "+") + (Math.abs(x) < 5e-6 ? "0" : digits(100 * Math.abs(x))) + " %";

byId("title").textContent = document.title = data.title || "Skies";
const range = (list, f, show) => {
  const all = list.map(f).filter(x => x !== null);
  if (!all.length) return "";
  const [low, high] = all.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
  return low === high ? show(low) : show(low) + " to " + show(high);
};
byId("lead").textContent = [skies.length === 1 ? "1 sky" : skies.length.toLocaleString("en") + " skies",
  data.sites.length === 1 ? data.sites[0] : data.sites.length + " sites",
  "sun " + range(skies, s => s.sun, degrees), range(skies, s => s.lux, lux)].filter(x => x).join(" \u00b7 ");
byId("foot").textContent = `skylapse ${data.version}, ${data.model}; ${data.space}, 1.0 in a map is ${data.white} cd/m\u00b2; made from ${data.config}`;

// Filters.
for (const [i, site] of data.sites.entries()) byId("by-site").append(make("option", {value: i}, site));
for (const t of [...new Set(skies.map(s => s.turbidity))].sort((a, b) => a - b))
  byId("by-turbidity").append(make("option", {value: t}, String(t)));
for (const [i, o] of data.outputs.entries()) byId("copy-output").append(make("option", {value: i}, o));
for (const s of skies)
  s.words = [data.sites[s.site], s.local, s.utc, s.camera, s.albedo, "turbidity " + s.turbidity, ...s.files.map(f => f.path)].join(" ").toLowerCase();
const number = id => byId(id).value === "" ? null : Number(byId(id).value);
const within = (x, from, to) => (from === null || x >= from - 1e-9) && (to === null || x <= to + 1e-9);
let shown = [], made = 0, down = false;
function filtered() {
  const words = byId("by-text").value.toLowerCase().split(/\s+/).filter(w => w);
  const site = byId("by-site").value, turbidity = byId("by-turbidity").value;
  const sun = [number("sun-from"), number("sun-to")], light = [number("lux-from"), number("lux-to")];
  return skies.filter(s => (site === "" || s.site === Number(site)) && (turbidity === "" || s.turbidity === Number(turbidity)) &&
    within(s.sun, ...sun) && ((light[0] === null && light[1] === null) || (s.lux !== null && within(s.lux, ...light))) &&
    words.every(w => s.words.includes(w)));
}
function sorted(list) {
  const key = byId("sort").value, of = s => key === "site" ? data.sites[s.site] : s[key];
  const order = (a, b) => {
    const x = of(a), y = of(b);
    if (x === null || y === null) return (x === null) - (y === null);
    const o = typeof x === "string" ? x.localeCompare(y) : x - y;
    return (down ? -o : o) || a.number - b.number;
  };
  return list.sort(order);
}
function card(s) {
  const shape = Math.max(0.75, s.width / s.height).toFixed(4);  // a tall strip is no tall card
  return make("button", {class: "sky", type: "button", "data-number": s.number, on: {click: () => open(s)}},
    make("img", {src: link(s.preview), alt: "", loading: "lazy", decoding: "async", style: "aspect-ratio:" + shape}),
    make("div", {}, make("b", {}, data.sites[s.site]), make("span", {}, make("i", {style: "font-style:normal"}, clock(s))),
      make("span", {}, make("i", {style: "font-style:normal"}, "sun " + degrees(s.sun)), make("i", {style: "font-style:normal"}, lux(s.lux))),
      s.choices.length ? make("em", {}, s.choices.join(" \u00b7 ")) : ""));
}
function addCards() {
  byId("grid").append(...shown.slice(made, made + kPage).map(card));
  made = Math.min(shown.length, made + kPage);
  byId("more").style.height = made < shown.length ? "1px" : "0";
}
function show() {
  shown = sorted(filtered());
  made = 0;
  byId("grid").replaceChildren();
  addCards();
  byId("none").hidden = shown.length > 0;
  byId("count").textContent = shown.length === skies.length ? `${skies.length} skies` : `${shown.length} of ${skies.length} skies`;
  watch();
}
// More cards when the end of those made comes near.
const observer = new IntersectionObserver(entries => {
  if (entries.some(e => e.isIntersecting) && made < shown.length) { addCards(); watch(); }
}, {rootMargin: "1200px"});
function watch() { observer.unobserve(byId("more")); if (made < shown.length) observer.observe(byId("more")); }

for (const control of byId("filters").querySelectorAll("input,select")) control.addEventListener("input", show);
byId("filters").addEventListener("submit", e => e.preventDefault());
byId("filters").addEventListener("reset", () => setTimeout(show));
byId("none-reset").addEventListener("click", () => byId("filters").reset());
byId("down").addEventListener("click", () => {
  down = !down;
  byId("down").setAttribute("aria-pressed", String(down));
  byId("down").textContent = down ? "\u2193" : "\u2191";
  show();
});

// Copying works from files, too, where the clipboard's own interface may be closed.
async function copy(text, button) {
  let done = false;
  try { await navigator.clipboard.writeText(text); done = true; } catch {
    const area = make("textarea", {class: "hidden"});
    area.value = text;
    document.body.append(area);
    area.select();
    done = document.execCommand("copy");
    area.remove();
  }
  const before = button.dataset.text || button.textContent;
  button.dataset.text = before;
  button.textContent = done ? "Copied" : "Not allowed";
  setTimeout(() => { button.textContent = before; }, 1400);
}
const pathsShown = () => shown.flatMap(s => s.files.filter(f => f.output === Number(byId("copy-output").value)).map(f => absolute(f.path)));
byId("copy-all").addEventListener("click", () => copy(pathsShown().join("\n"), byId("copy-all")));

// One sky, with all its files.
let current = null, opener = null;
const fact = (name, value) => value === "" || value === null ? "" : make("div", {}, make("span", {}, name), value);
function fileRow(f) {
  const error = errorOf(f), button = make("button", {type: "button", on: {click: () => copy(absolute(f.path), button)}}, "Copy path");
  const rows = [make("span", {}, make("a", {href: link(f.path)}, f.path)), button,
    make("small", {}, [data.outputs[f.output], bytes(f.bytes)].join(", "))];
  const apart = data.without_disc[f.output];
  const isMap = /^(map|sky) /.test(data.outputs[f.output]);  // harmonics and filtered cubes are off by their theory
  if (error !== null)
    rows.push(make("small", {class: Math.abs(error) > 0.005 && isMap ? "off" : null},
      `level ground gets ${lux(f.has)}, by the model ${lux(f.true)}: ` + (apart ? "with the sun beside it " : "") + percent(error)));
  else if (f.true === 0) rows.push(make("small", {}, "no light by the model"));
  if (f.lost > 0 && !apart) rows.push(make("small", {class: "off"}, `${digits(100 * f.lost)} % of the sum of all values cut off`));
  if (f.scale !== undefined && f.scale !== 1) rows.push(make("small", {}, `values were multiplied by ${f.scale}`));
  rows.push(make("small", {}, make("code", {}, "sha256 " + f.sha256)));
  return make("li", {}, ...rows);
}
function viewer(s) {
  const picture = make("img", {src: link(s.preview), alt: "Preview of this sky"});
  if (!s.lat_long) return make("div", {class: "view"}, picture);
  const canvas = make("canvas", {width: 960, height: 540, tabindex: 0, role: "img"}), where = make("p", {}, "drag to look around");
  canvas.addEventListener("turned", e => { where.textContent = `${compass(e.detail.azimuth)} ${Math.round(e.detail.azimuth)}\u00b0, ${upward(e.detail.elevation, "\u00b0")} \u2014 drag to look around`; });
  // On the sun, but for one high up or near the horizon, which from space is far below the level.
  const elevation = Math.max(s.horizon + 10, Math.min(35, s.apparent));
  panorama(canvas, picture, {azimuth: s.azimuth, elevation, heading: s.heading});
  return make("div", {class: "view"}, canvas, where);
}
function open(s) {
  if (byId("detail").hidden) opener = document.activeElement;
  current = s;
  const at = shown.indexOf(s);
  const step = (text, by) => {
    const button = make("button", {type: "button", on: {click: () => move(by)}}, text);
    button.disabled = !shown[at + by];
    return button;
  };
  const close = make("button", {type: "button", id: "close", on: {click: hide}}, "Close");
  byId("detail").replaceChildren(
    make("div", {class: "top"}, step("\u2190 Before", -1), make("span", {class: "note"}, at < 0 ? "" : `${at + 1} of ${shown.length}`), step("Next \u2192", 1), close),
    viewer(s), make("h2", {id: "detail-title"}, `${data.sites[s.site]}, ${clock(s, true)}`),
    make("div", {class: "facts"}, fact("sun, true elevation", degrees(s.sun)), fact("sun, apparent", degrees(s.apparent)),
      fact("sun, azimuth", degrees(s.azimuth)), fact("level ground", lux(s.lux)), fact("of it sky", lux(s.sky)), fact("facing the sun", lux(s.direct)),
      fact("turbidity", String(s.turbidity)), fact("ground albedo", s.albedo), fact("exposure", "EV " + s.ev.toFixed(1)),
      fact("UTC", s.utc), fact("camera", s.camera), fact("sky", String(s.number))),
    make("ul", {class: "files"}, ...s.files.map(fileRow)));
  byId("detail").hidden = false;
  byId("detail").scrollTop = 0;
  history.replaceState(null, "", "#" + s.number);
  close.focus({preventScroll: true});
}
function hide() {
  if (byId("detail").hidden) return;
  byId("detail").hidden = true;
  history.replaceState(null, "", location.pathname + location.search);
  const back = current && byId("grid").querySelector(`[data-number="${current.number}"]`);
  (back || opener || document.body).focus({preventScroll: false});
  current = null;
}
function move(by) {
  const next = shown[shown.indexOf(current) + by];
  if (next) open(next);
}
document.addEventListener("keydown", e => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(document.activeElement.tagName);
  if (current) {
    if (e.key === "Escape") hide();
    else if (e.key === "ArrowLeft") move(-1);
    else if (e.key === "ArrowRight") move(1);
    else if (e.key === "Tab") keepInside(e);
    return;
  }
  if (e.key === "/" && !typing) { e.preventDefault(); byId("by-text").focus(); return; }
  const cards = [...byId("grid").children], at = cards.indexOf(document.activeElement);
  if (at < 0 || !e.key.startsWith("Arrow")) return;
  const columns = Math.max(1, cards.findIndex(c => c.offsetTop > cards[0].offsetTop));
  const to = cards[at + {ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns}[e.key]];
  if (to) { e.preventDefault(); to.focus(); }
});
function keepInside(e) {
  const stops = [...byId("detail").querySelectorAll("button:not([disabled]),a,canvas")];
  const first = stops[0], last = stops[stops.length - 1];
  if (e.shiftKey && document.activeElement === first) { e.preventDefault(); last.focus(); }
  else if (!e.shiftKey && document.activeElement === last) { e.preventDefault(); first.focus(); }
}

byId("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});
show();
const wanted = skies.find(s => "#" + s.number === location.hash);
if (wanted) open(wanted);
})();
