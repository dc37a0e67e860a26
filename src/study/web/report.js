(() => {
const data = JSON.parse(document.getElementById("data").textContent);
const percent = share => share === null ? "" : digits(100 * share) + " %";
const time = ms => ms === null ? "" : ms < 10 ? digits(ms) + " ms" : ms < 1000 ? Math.round(ms) + " ms"
  : ms < 120e3 ? digits(ms / 1000) + " s" : ms < 7200e3 ? Math.round(ms / 60e3) + " min" : Math.round(ms / 3600e3) + " h";
const megabytes = mb => mb === null ? "" : mb === 0 ? "0" : digits(mb);
const error = r => r.rms === null ? "no number" : (r.below_noise ? "< " : "") + percent(r.rms);
const measured = scene => scene.rungs.filter(r => !r.skipped && r.rms !== null);

// The short answer: time of a frame for pictures of another size, with a share of the tables.
const kLevels = [0.01, 0.02, 0.05, 0.1];
const pixelsOf = () => data.pixels * Math.pow(10, byId("size").value / 30);
const manyOf = () => Math.round(Math.pow(10, byId("many").value / 10));
const timeOf = (r, pixels, many) => r.once + r.pixels * pixels / data.pixels + r.prepare / many;
const cheapest = (scene, level, pixels, many) => {
  let best = null;
  for (const r of measured(scene)) {
    const t = timeOf(r, pixels, many);
    if (r.rms <= level && (best === null || t < best.t)) best = {r, t};
  }
  return best;
};
function showAnswers() {
  const pixels = pixelsOf(), many = manyOf();
  byId("size-text").textContent = (pixels / 1e6).toPrecision(2) + " megapixels";
  byId("many-text").textContent = many === 1 ? "1" : many.toLocaleString("en");
  const head = make("tr", {}, make("th", {scope: "col"}, "Scene"),
    ...kLevels.map(l => make("th", {scope: "col"}, "within " + percent(l))));
  const rows = data.scenes.map(scene => make("tr", {},
    make("th", {scope: "row"}, scene.title),
    ...kLevels.map(level => {
      const best = cheapest(scene, level, pixels, many);
      if (!best) return make("td", {class: "none"}, "no rung here");
      return make("td", {}, make("b", {}, time(best.t)), best.r.label,
        make("small", {}, error(best.r) + " off"));
    })));
  byId("cheapest").replaceChildren(byId("cheapest").caption, make("thead", {}, head), make("tbody", {}, ...rows));
}
byId("size").addEventListener("input", showAnswers);
byId("many").addEventListener("input", showAnswers);
byId("answer-note").textContent = data.scenes.some(s => s.rungs.some(r => r.scaled && !r.skipped))
  ? "Rungs of the reference are measured in a picture of 36 x 18 pixels and counted up." : "";

// Details of one rung, in a panel.
const kFacts = [["error, rms", r => error(r)], ["95 % are below", r => percent(r.p95)], ["largest", r => percent(r.max)],
  ["zenith", r => percent(r.zenith)], ["horizon", r => percent(r.horizon)], ["aureole", r => percent(r.aureole)],
  ["away from the sun", r => percent(r.anti_solar)], ["sun's disc", r => percent(r.disc)],
  ["sky on level ground", r => percent(r.irradiance)], ["mean \u0394E", r => digits(r.de)], ["\u0394u'v', rms", r => digits(r.duv)],
  ["sun's place", r => r.arcsec < 0.005 ? "same" : r.arcsec < 100 ? digits(r.arcsec) + "\u2033" : digits(r.arcsec / 3600) + "\u00b0"],
  ["frame, core time", r => time(r.ms)], ["quartiles", r => time(r.q1) + " to " + time(r.q3)], ["frame, on the clock", r => time(r.clock)], ["first frame", r => time(r.first)],
  ["tables", r => r.tables ? time(r.tables) + ", " + megabytes(r.table_mb) + " MB" : "none"],
  ["memory rise", r => r.rise_mb === null ? "not known" : megabytes(r.rise_mb) + " MB"]];
const picture = (url, alt, caption) => make("div", {}, make("img", {src: url, alt, width: 128, height: 128}), caption);
const trio = (scene, r) => r.picture ? make("div", {class: "trio"}, picture(r.picture, "Sky of " + r.label, "this rung"),
  picture(scene.truth, "True sky", "truth"), picture(r.map, "Map of the error", "error")) : "";
let opener = null;
function showDetail(scene, r) {
  const close = make("button", {class: "close", type: "button", on: {click: hideDetail}}, "close");
  const facts = r.skipped ? make("p", {}, "Not measured: " + r.skipped)
    : make("div", {class: "facts"}, ...kFacts.map(([name, f]) => make("div", {}, make("span", {}, name), f(r))));
  if (byId("detail").hidden) opener = document.activeElement;
  byId("detail").replaceChildren(close, make("h3", {}, r.label), make("p", {class: "note"}, scene.title),
    trio(scene, r), facts, make("p", {}, make("code", {}, r.setting.split(" ").map(s => "--set " + s).join(" "))));
  byId("detail").hidden = false;
  close.focus({preventScroll: true});
}
function hideDetail() {
  if (byId("detail").hidden) return;
  byId("detail").hidden = true;
  if (opener && opener.focus) opener.focus({preventScroll: true});
}
document.addEventListener("keydown", e => { if (e.key === "Escape") hideDetail(); });
for (const g of document.querySelectorAll("g[data-rung]")) {
  const scene = data.scenes[g.dataset.scene], r = scene.rungs[g.dataset.rung];
  g.setAttribute("tabindex", "0");
  g.setAttribute("role", "button");
  g.setAttribute("aria-label", r.label + ", " + error(r) + " off, " + time(r.ms));
  g.addEventListener("click", () => showDetail(scene, r));
  g.addEventListener("keydown", e => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); showDetail(scene, r); } });
}

// Pictures.
let lookAt = 0, all = false;
function showGallery() {
  const scene = data.scenes[lookAt];
  if (!scene) return;
  byId("look-tabs").replaceChildren(...data.scenes.map((s, i) => make("button",
    {type: "button", "aria-pressed": String(i === lookAt), on: {click: () => { lookAt = i; showGallery(); }}}, s.title)));
  const rungs = scene.rungs.filter(r => r.picture && (all || r.group === "model" || r.front));
  byId("gallery").replaceChildren(...rungs.map(r => make("div",
    {class: "card", tabindex: 0, role: "button", on: {click: () => showDetail(scene, r),
      keydown: e => { if (e.key === "Enter") showDetail(scene, r); }}},
    make("h3", {}, r.label), make("p", {}, error(r) + " off, " + time(r.ms)), trio(scene, r))));
  byId("more").textContent = all ? "Show the models and the front" : "Show all " + scene.rungs.filter(r => r.picture).length;
}
byId("more").addEventListener("click", () => { all = !all; showGallery(); });

// The table.
const rows = data.scenes.flatMap(scene => scene.rungs.map(r => ({scene, r})));
const kColumns = [["Rung", x => x.r.label, x => x.r.label], ["Scene", x => x.scene.title, x => x.scene.id],
  ["Error, rms", x => error(x.r), x => x.r.rms], ["95 %", x => percent(x.r.p95), x => x.r.p95],
  ["Largest", x => percent(x.r.max), x => x.r.max], ["Zenith", x => percent(x.r.zenith), x => x.r.zenith],
  ["Horizon", x => percent(x.r.horizon), x => x.r.horizon], ["Aureole", x => percent(x.r.aureole), x => x.r.aureole],
  ["Away from the sun", x => percent(x.r.anti_solar), x => x.r.anti_solar], ["Disc", x => percent(x.r.disc), x => x.r.disc],
  ["Irradiance", x => percent(x.r.irradiance), x => x.r.irradiance], ["\u0394u'v'", x => digits(x.r.duv), x => x.r.duv],
  ["\u0394E", x => digits(x.r.de), x => x.r.de], ["\u0394E 95 %", x => digits(x.r.de_p95), x => x.r.de_p95],
  ["Sun, arcsec", x => digits(x.r.arcsec), x => x.r.arcsec], ["Frame, core time", x => time(x.r.ms), x => x.r.ms],
  ["Frame, clock", x => time(x.r.clock), x => x.r.clock],
  ["First frame", x => time(x.r.first), x => x.r.first], ["Tables", x => x.r.tables ? time(x.r.tables) : "", x => x.r.tables],
  ["Tables, MB", x => megabytes(x.r.table_mb), x => x.r.table_mb], ["Rise, MB", x => megabytes(x.r.rise_mb), x => x.r.rise_mb]];
let sortBy = 2, up = true;
const compare = (a, b) => {
  const x = kColumns[sortBy][2](a), y = kColumns[sortBy][2](b);
  const noX = x === null || x === undefined, noY = y === null || y === undefined;
  if (noX || noY) return noX - noY;
  const order = typeof x === "string" ? x.localeCompare(y) : x - y;
  return up ? order : -order;
};
function showTable() {
  const scene = byId("by-scene").value, group = byId("by-group").value, text = byId("by-text").value.toLowerCase();
  const kept = rows.filter(x => (!scene || x.scene.id === scene) && (!group || x.r.group === group) &&
    (!byId("by-front").checked || x.r.front) && (!text || (x.r.label + " " + x.r.setting).toLowerCase().includes(text)));
  kept.sort(compare);
  byId("rungs").tHead.replaceChildren(make("tr", {}, ...kColumns.map(([name], i) => make("th",
    {scope: "col", "aria-sort": i === sortBy ? (up ? "ascending" : "descending") : null},
    make("button", {type: "button", on: {click: () => { up = i === sortBy ? !up : true; sortBy = i; showTable(); }}}, name)))));
  byId("rungs").tBodies[0].replaceChildren(...kept.map(x => make("tr", {class: x.r.front ? "front" : null,
    on: {click: () => showDetail(x.scene, x.r)}}, ...(x.r.skipped
      ? [make("td", {}, x.r.label), make("td", {}, x.scene.title), make("td", {colspan: kColumns.length - 2, style: "text-align:left"}, "not measured: " + x.r.skipped)]
      : kColumns.map(([, show]) => make("td", {}, show(x)))))));
  byId("count").textContent = kept.length + " of " + rows.length + " rows; bold: on the front of its scene";
}
for (const s of data.scenes) byId("by-scene").append(make("option", {value: s.id}, s.title));
for (const g of data.groups)
  if (rows.some(x => x.r.group === g.name)) byId("by-group").append(make("option", {value: g.name}, g.title));
for (const id of ["by-scene", "by-group", "by-text", "by-front"]) byId(id).addEventListener("input", showTable);

const m = data.machine;
byId("machine").textContent = `${data.command} - ${data.date}, ${time(1000 * data.seconds)}. ${m.cpu}, ${m.cores} cores, ${m.system}, ${digits(m.load)} threads busy when it began; ` +
  `GL: ${m.renderer || "not used"}; skylapse ${m.version}, sources ${m.source}. ` +
  `Truth in ${data.wavelengths} wavelengths: ` + data.scenes.map(s => `${s.id} ${s.directions} directions, ${s.paths.toLocaleString("en")} paths` +
  (s.truth_kept ? " (kept from an earlier run)" : ` in ${time(1000 * s.truth_seconds)}`)).join("; ") + ".";
showAnswers();
showGallery();
showTable();
})();
