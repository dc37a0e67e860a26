// The list of pairs and what is told of the chosen one.
const kVerdicts = [{name: "same", icon: "\u2713"}, {name: "warning", icon: "\u25b2"}, {name: "different", icon: "\u2715"}, {name: "unreadable", icon: "\u2298"}];
const kOrder = [2, 3, 1, 0], kPage = 200;
const icon = v => make("span", {class: "icon v" + v, "aria-hidden": "true"}, kVerdicts[v].icon);
const badge = v => make("span", {class: "badge v" + v}, icon(v), kVerdicts[v].name);
const num = x => x === null || x === undefined ? NaN : Number(x);  // "NaN" and "Infinity" are texts in JSON
const signed = x => (x < 0 ? "\u2212" : "+") + (Math.abs(x) >= 1e5 ? Math.abs(x).toExponential(1) : digits(Math.abs(x), 3));
const plain = x => x !== x ? "not a number" : x === Infinity ? "infinite" : x === -Infinity ? "minus infinite" : Math.abs(x) >= 1e6 || (x !== 0 && Math.abs(x) < 1e-6) ? x.toExponential(2) : digits(x, 3);
const withUnit = (x, unit) => plain(unit === "%" ? 100 * x : x) + (unit && isFinite(x) ? " " + unit : "");
const placeText = p => p ? `(${p[0]}, ${p[1]})` + (p[6] ? ", " + p[6] : "") + (typeof p[3] === "number" ? `, azimuth ${p[3].toFixed(1)}\u00b0, elevation ${p[4].toFixed(1).replace("-", "\u2212")}\u00b0` : "") +
  (typeof p[5] === "number" ? `, ${p[5].toFixed(1)}\u00b0 from the sun` : "") + (p[2] ? `, channel ${p[2]}` : "") : "";
const kind = m => { const [name, unit, warn, fail, below] = data.kinds[m[0]]; return {name, unit, warn: num(warn), fail: num(fail), below, value: num(m[1]), verdict: m[2] || 0, place: m[3] || null}; };
function failLimit(pair, name) {
  const found = pair.m.map(kind).find(m => m.name === name);
  return found && found.fail > 0 && isFinite(found.fail) ? found.fail : 0;
}
const ratioText = x => x === Infinity || x !== x ? "beyond any" : x === 0 ? "" : x >= 1e4 ? x.toExponential(1) + "\u00d7" : digits(x) + "\u00d7";
const ratioOf = m => { const limit = isNaN(m.fail) ? m.warn : m.fail; return isNaN(limit) ? 0 : isNaN(m.value) ? Infinity : m.below ? limit / m.value : m.value === 0 ? 0 : m.value / limit; };

// The head: what happened, in one line.
const plural = (n, one, many) => n.toLocaleString("en") + " " + (n === 1 ? one : many);
{
  const c = data.counts, all = data.pairs.length, verdict = data.unreadable ? 3 : data.verdict, wholeFails = data.findings.filter(f => f[0] === 2).length;
  const text = [c.different ? `${c.different.toLocaleString("en")} of ${plural(all, "picture", "pictures")} ${c.different === 1 ? "differs" : "differ"}` : "",
    c.unreadable ? plural(c.unreadable, "picture cannot", "pictures cannot") + " be read" : "",
    wholeFails ? plural(wholeFails, "finding", "findings") + " of the whole" : ""].filter(x => x).join(", ");
  byId("verdict").className = "v" + verdict;
  byId("verdict").append(icon(verdict), " " + (text || (all === 0 ? "No pictures were compared" : c.warning ? `No failure, ${plural(c.warning, "warning", "warnings")} in ${plural(all, "picture", "pictures")}`
    : data.verdict === 1 ? "No failure, with warnings" : all === 1 ? "The picture agrees" : `All ${all.toLocaleString("en")} pictures agree`)));
  document.title = byId("verdict").textContent.trim() + " \u2013 skylapse diff";
  const profiles = [...new Set(data.pairs.map(p => p.p))].filter(p => p);
  byId("lead").append(make("span", {}, make("b", {}, "A"), " " + data.a), make("span", {}, make("b", {}, "B"), " " + data.b),
    ...(profiles.length ? [make("span", {}, make("b", {}, profiles.length === 1 ? "profile" : "profiles"), " " + profiles.slice(0, 5).join(", "))] : []));
  const told = f => make("li", {class: "v" + f[0]}, icon(f[0]), make("b", {}, f[1]), " " + f[2]), first = 3, most = 500;
  byId("whole").append(...data.findings.slice(0, first).map(told));
  if (data.findings.length > first)
    byId("whole-more").append(make("summary", {}, `${(data.findings.length - first).toLocaleString("en")} more findings of the whole`),
      make("ul", {}, ...data.findings.slice(first, most).map(told), data.findings.length > most ? make("li", {}, `and ${(data.findings.length - most).toLocaleString("en")} more`) : ""));
  byId("whole-more").hidden = data.findings.length <= first;
  byId("foot").textContent = `${data.program}; compared in ${digits(num(data.seconds), 3)} s. The worst ${data.pairs.filter(p => p.pic && p.pic.note === undefined).length.toLocaleString("en")} pairs carry their pixels.`;
  const limits = data.kinds.filter(k => k[2] !== null || k[3] !== null);
  byId("limit-table").tBodies[0].append(...limits.map(([name, unit, warn, fail, below]) => make("tr", {}, make("th", {scope: "row"}, name),
    ...[warn, fail].map(x => make("td", {}, x === null ? "" : (below ? "below " : "above ") + withUnit(num(x), unit))))));
  byId("limits").hidden = limits.length === 0;
}

// Filters and the table.
const shownVerdicts = new Set(), rows = data.pairs.map((p, i) => ({p, i, check: p.v ? p.w[0] || "" : "", ratio: num(p.w[1] || 0), region: p.v ? p.w[2] || "" : ""}));
byId("chips").append(...kOrder.filter(v => data.counts[kVerdicts[v].name] > 0).map(v => make("button", {type: "button", class: "chip v" + v, "aria-pressed": "false",
  on: {click: e => { shownVerdicts.has(v) ? shownVerdicts.delete(v) : shownVerdicts.add(v); e.currentTarget.setAttribute("aria-pressed", String(shownVerdicts.has(v))); limit = kPage; showRows(); }}},
  icon(v), data.counts[kVerdicts[v].name].toLocaleString("en") + " " + kVerdicts[v].name)));
const failing = rows.filter(r => r.p.v > 0);
const fill = (id, values) => byId(id).append(...[...new Set(values)].filter(x => x).sort().map(x => make("option", {}, x)));
fill("by-check", failing.flatMap(r => [r.check, ...r.p.f.map(f => f[1]), ...r.p.m.filter(m => m[2]).map(m => data.kinds[m[0]][0])]));
fill("by-region", failing.flatMap(r => [r.region, ...r.p.m.filter(m => m[2] && m[3] && m[3][6]).map(m => m[3][6])]));
const hasCheck = (r, check) => r.check === check || r.p.f.some(f => f[1] === check) || r.p.m.some(m => m[2] && data.kinds[m[0]][0] === check);
const hasRegion = (r, region) => r.region === region || r.p.m.some(m => m[2] && m[3] && m[3][6] === region);
const collator = new Intl.Collator("en", {numeric: true});
const kColumns = [["Picture", (a, b) => collator.compare(a.p.n, b.p.n)], ["Verdict", (a, b) => a.i - b.i], ["Check", (a, b) => collator.compare(a.check || "\uffff", b.check || "\uffff") || a.i - b.i],
  ["Region", (a, b) => collator.compare(a.region || "\uffff", b.region || "\uffff") || a.i - b.i], ["\u00d7 limit", (a, b) => (b.ratio === a.ratio ? 0 : b.ratio - a.ratio) || a.i - b.i]];
let sortBy = 1, up = true, limit = kPage, chosen = -1, kept = rows;
function showRows() {
  const name = byId("by-name").value.toLowerCase(), check = byId("by-check").value, region = byId("by-region").value;
  kept = rows.filter(r => (!shownVerdicts.size || shownVerdicts.has(r.p.v)) && (!name || r.p.n.toLowerCase().includes(name)) && (!check || hasCheck(r, check)) && (!region || hasRegion(r, region)));
  kept.sort(kColumns[sortBy][1]);
  if (!up) kept.reverse();
  byId("rows").tHead.replaceChildren(make("tr", {}, ...kColumns.map(([title], i) => make("th", {scope: "col", "aria-sort": i === sortBy ? (up ? "ascending" : "descending") : null},
    make("button", {type: "button", on: {click: () => { up = i === sortBy ? !up : true; sortBy = i; showRows(); byId("rows").tHead.querySelectorAll("button")[i].focus(); }}}, title)))));
  byId("rows").tBodies[0].replaceChildren(...kept.slice(0, limit).map(rowOf));
  byId("count").textContent = kept.length === rows.length ? plural(rows.length, "pair", "pairs") : `${kept.length.toLocaleString("en")} of ${plural(rows.length, "pair", "pairs")}`;
  byId("more").hidden = kept.length <= limit;
  markChosen();
}
const breakable = name => name.replace(/[._-]/g, "$&\u200b");  // long names may go on below
function rowOf(r) {
  const thumb = r.p.pic && byId("e" + r.i) ? make("canvas", {class: "thumb", width: 72, height: 36, "data-thumb": r.i, "aria-hidden": "true"}) : "";
  if (thumb) thumbs.observe(thumb);
  return make("tr", {"data-pair": r.i, class: "v" + r.p.v, on: {click: () => choose(r.i, true)}},
    make("td", {class: "name"}, make("div", {}, thumb, make("span", {}, make("button", {type: "button"}, r.p.n), r.p.v ? make("small", {}, r.p.s) : ""))),
    make("td", {}, make("span", {class: "badge v" + r.p.v, title: kVerdicts[r.p.v].name}, icon(r.p.v), make("span", {class: "hidden"}, kVerdicts[r.p.v].name))), make("td", {}, breakable(r.check)), make("td", {}, r.region), make("td", {class: "number"}, ratioText(r.ratio)));
}
// Where the errors lie, small; made when the row comes into view.
const thumbs = new IntersectionObserver(entries => {
  for (const e of entries) if (e.isIntersecting) thumbs.unobserve(e.target), thumbQueue.push(e.target);
  drawThumbs();
});
const thumbQueue = [];
let drawing = false;
async function drawThumbs() {
  if (drawing) return;
  drawing = true;
  while (thumbQueue.length) {
    const target = thumbQueue.shift(), i = Number(target.dataset.thumb), {w, h} = data.pairs[i].pic.a, errors = await errorsOf(i);
    const W = target.width = Math.min(72, w), H = target.height = Math.max(1, Math.min(72, Math.round(W * h / w))), largest = new Float32Array(W * H);
    for (let y = 0, n = 0; y < h; ++y)
      for (let x = 0; x < w; ++x, ++n) {
        const at = Math.floor(y * H / h) * W + Math.floor(x * W / w);
        if (Math.abs(errors[n]) > Math.abs(largest[at])) largest[at] = errors[n];
      }
    const range = failLimit(data.pairs[i], data.pairs[i].pic.display ? "display.max" : "relative.max") || Math.max(1e-6, quantile(sizesOf(largest), 0.99));
    target.getContext("2d").putImageData(falseColours(largest, W, H, range), 0, 0);
  }
  drawing = false;
}
function markChosen() {
  for (const row of byId("rows").tBodies[0].rows) {
    if (Number(row.dataset.pair) === chosen) row.setAttribute("aria-current", "true"); else row.removeAttribute("aria-current");
  }
}
function step(by) {
  const at = kept.findIndex(r => r.i === chosen), next = kept[at < 0 ? 0 : Math.min(kept.length - 1, Math.max(0, at + by))];
  if (!next) return;
  if (kept.indexOf(next) >= limit) limit += kPage, showRows();
  choose(next.i, false);
  const row = byId("rows").querySelector("tr[aria-current]"), box = byId("rows-scroll");
  if (row && (row.offsetTop < box.scrollTop + 40 || row.offsetTop + row.offsetHeight > box.scrollTop + box.clientHeight)) box.scrollTop = row.offsetTop - 60;
}

// The chosen pair.
async function choose(i, goThere) {
  chosen = i;
  const p = data.pairs[i];
  markChosen();
  history.replaceState(null, "", "#" + encodeURIComponent(p.n));
  const place = p.f.map(f => f[3]).find(x => x) || worstMeasure(p)?.place || null;
  byId("pair-head").replaceChildren(make("h2", {}, badge(p.v), " " + p.n), make("p", {class: "summary"}, p.s || "Nothing to tell."),
    ...(p.g ? [make("p", {class: "note"}, "Golden of " + p.g)] : []), ...(p.e && p.e[1] ? [make("p", {class: "note"}, p.e[1])] : []));
  showFindings(p), showMeasures(p), showFacts(p);
  const none = byId("no-pictures"), held = p.pic && p.pic.note === undefined;
  none.hidden = Boolean(held), byId("viewer").hidden = !held;
  none.replaceChildren(...(held ? [] : p.v === 3 || p.e ? ["A file of this pair cannot be read: there are no pictures to show."]
    : p.pic ? ["No pictures: " + p.pic.note + "."] : ["Only the worst pairs carry their pixels in this page. For this one: ", make("code", {}, `skylapse diff ${quoted(p.a[0])} ${quoted(p.b[0])} --html DIR`)]));
  if (goThere && innerWidth < 1100) byId("detail").scrollIntoView(), byId("detail").focus({preventScroll: true});
  if (!held) return void (view.number = -1, view.pictures = null);
  try {
    await openViewer(i, place);
    byId("worst").disabled = !place;
  } catch (problem) {
    if (chosen === i) byId("viewer").hidden = true, none.hidden = false, none.textContent = "The pictures cannot be shown: " + problem.message;
  }
}
const quoted = text => "'" + (text || "").replace(/'/g, "'\\''") + "'";
const worstMeasure = p => p.m.map(kind).filter(m => m.place).sort((a, b) => b.verdict - a.verdict || ratioOf(b) - ratioOf(a))[0];
const placeLink = place => place ? make("button", {type: "button", class: "place", on: {click: () => { toWorst(place); byId("stage").scrollIntoView({block: "nearest"}); }}}, placeText(place)) : "";
function showFindings(p) {
  byId("findings").replaceChildren(...(p.f.length ? [make("h3", {}, "Findings"), make("ul", {class: "findings"}, ...p.f.map(f => make("li", {class: "v" + f[0]}, icon(f[0]), make("b", {}, f[1]), " " + f[2] + " ", placeLink(f[3]))))] : []));
}
// Bars end at the limit that fails while values are within it; beyond, the limit moves to the left.
function bar(m) {
  const limit = isNaN(m.fail) ? m.warn : m.fail;
  if (isNaN(limit)) return "";
  const value = isFinite(m.value) ? Math.abs(m.value) : Infinity, full = m.below ? Math.max(value, limit) * 1.25 : Math.max(limit * 1.25, value) || 1;
  const share = x => value === Infinity && x !== Infinity ? (limit > 0 ? 4 : 0) : 100 * Math.min(1, x / full);
  const tick = (x, name) => isNaN(x) ? "" : make("i", {class: "tick " + name, style: `left:${share(x)}%`});
  return make("span", {class: "bar-track", "aria-hidden": "true"}, make("span", {class: "v" + m.verdict, style: `width:${value === Infinity ? 100 : Math.max(value > 0 ? 1 : 0, share(value))}%`}), tick(m.warn, "warn"), tick(m.fail, "fail"));
}
function showMeasures(p) {
  const all = p.m.map(kind), row = m => make("tr", {class: "v" + m.verdict}, make("th", {scope: "row"}, m.verdict ? icon(m.verdict) : "", m.name, m.verdict ? make("span", {class: "hidden"}, " " + kVerdicts[m.verdict].name) : ""), make("td", {class: "number"}, withUnit(m.value, m.unit)),
    make("td", {class: "number"}, ["warn", "fail"].filter(k => !isNaN(m[k])).map(k => withUnit(m[k], m.unit)).join(" / ")), make("td", {}, bar(m)), make("td", {}, placeLink(m.place)));
  const table = list => make("div", {class: "scroll"}, make("table", {class: "measures"}, make("caption", {class: "hidden"}, "Measures with their limits"), make("thead", {}, make("tr", {}, ...["Measure", "value", "warns / fails", "", "where"].map(t => make("th", {scope: "col"}, t)))), make("tbody", {}, ...list.map(row))));
  const bad = all.filter(m => m.verdict).sort((a, b) => b.verdict - a.verdict || ratioOf(b) - ratioOf(a)), limited = all.filter(m => !m.verdict && !(isNaN(m.warn) && isNaN(m.fail))), free = all.filter(m => !m.verdict && isNaN(m.warn) && isNaN(m.fail));
  const fold = (title, list, open) => list.length ? [make("details", open ? {open: ""} : {}, make("summary", {}, `${title} (${list.length})`), table(list))] : [];
  byId("measures").replaceChildren(...(bad.length ? [make("h3", {}, "Beyond their limits"), table(bad)] : []), ...fold("Within their limits", limited, !bad.length && !p.f.length), ...fold("Without limits", free, false));
}
function showFacts(p) {
  const names = ["file", "format", "stored as", "width", "height", "channels", "time", "model", "renderer"];
  const value = (file, i) => i === 5 ? (file[5] || []).join(" ") : file[i] || "";
  const list = names.map((name, i) => [name, value(p.a, i), value(p.b, i)]).filter(([, a, b]) => a !== "" || b !== "");
  const extra = [p.sun ? `sun at azimuth ${p.sun[0].toFixed(2)}\u00b0, elevation ${p.sun[1].toFixed(2)}\u00b0` : "", `read in ${digits(num(p.t[0]))} ms, measured in ${digits(num(p.t[1]))} ms` + (num(p.t[2]) > 0 ? `, FLIP in ${digits(num(p.t[2]))} ms` : "")].filter(x => x);
  byId("facts").replaceChildren(make("h3", {}, "Files"), make("div", {class: "scroll"}, make("table", {class: "facts"}, make("caption", {class: "hidden"}, "Facts of both files"), make("thead", {}, make("tr", {}, make("td", {}), make("th", {scope: "col"}, "A, reference"), make("th", {scope: "col"}, "B, tested"))),
    make("tbody", {}, ...list.map(([name, a, b]) => make("tr", {class: name !== "file" && a !== b ? "unlike" : null}, make("th", {scope: "row"}, name, name !== "file" && a !== b ? " \u2260" : ""), make("td", {}, String(a)), make("td", {}, String(b))))))), make("p", {class: "note"}, extra.join("; ") + "."));
}

for (const id of ["by-name", "by-check", "by-region"]) byId(id).addEventListener("input", () => { limit = kPage; showRows(); });
byId("more").addEventListener("click", () => { limit += kPage; showRows(); });
function toggleHelp() {
  byId("help").hidden = !byId("help").hidden;
  byId("help-button").setAttribute("aria-expanded", String(!byId("help").hidden));
}
byId("help-button").addEventListener("click", toggleHelp);
byId("theme").addEventListener("click", () => {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});
showRows();
const wanted = location.hash.length > 1 ? data.pairs.findIndex(p => { try { return p.n === decodeURIComponent(location.hash.slice(1)); } catch { return false; } }) : -1;
const seen = data.pairs.findIndex(p => p.v && p.pic && p.pic.note === undefined);  // the worst with something to see
if (wanted >= 0 || rows.length) choose(wanted >= 0 ? wanted : Math.max(0, seen), false);
else byId("list").hidden = byId("detail").hidden = true;
