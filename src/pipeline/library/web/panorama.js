// A look around inside a lat-long picture, drawn on a plain canvas: WebGL may not read pictures of
// a page that is opened from a file. The view is cut into small triangles; in each of them the
// picture is drawn by an affine map.
function panorama(canvas, picture, start) {
  const kRadians = Math.PI / 180, kColumns = 28, kRows = 16;
  const view = {azimuth: start.azimuth, elevation: start.elevation, fov: 75};
  const context = canvas.getContext("2d");
  // The picture with a margin of its other side, so that no edge is smoothed where it closes.
  const kMargin = 2, source = document.createElement("canvas");
  function load() {
    source.width = picture.naturalWidth + 2 * kMargin;
    source.height = picture.naturalHeight;
    const into = source.getContext("2d");
    for (const turn of [-1, 1, 0]) into.drawImage(picture, kMargin + turn * picture.naturalWidth, 0);
    draw();
  }

  // Where the picture shows what the canvas has at x, y (-1..1): turns from its left edge, and
  // parts of its height.
  function position(x, y) {
    const reach = Math.tan(view.fov * kRadians / 2), high = reach * canvas.height / canvas.width;
    const e = view.elevation * kRadians;
    const forward = Math.cos(e) - y * high * Math.sin(e), up = Math.sin(e) + y * high * Math.cos(e);
    const right = x * reach, flat = Math.hypot(right, forward);
    return {u: Math.atan2(right, forward) / (2 * Math.PI) + (view.azimuth - start.heading) / 360 + 0.5,
            v: 0.5 - Math.atan2(up, flat) / Math.PI};
  }

  function triangle(a, b, c, w, h) {
    // Grown a little about its middle, so that no gap shows between neighbours.
    const mx = (a.x + b.x + c.x) / 3, my = (a.y + b.y + c.y) / 3;
    const grown = p => { const l = Math.hypot(p.x - mx, p.y - my) || 1; return [p.x + (p.x - mx) / l, p.y + (p.y - my) / l]; };
    const det = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
    if (Math.abs(det) < 1e-12) return;
    const solve = (p, q, r) => {
      const s = ((q - p) * (c.v - a.v) - (r - p) * (b.v - a.v)) / det, t = ((r - p) * (b.u - a.u) - (q - p) * (c.u - a.u)) / det;
      return [s, t, p - s * a.u - t * a.v];
    };
    const [xu, xv, x0] = solve(a.x, b.x, c.x), [yu, yv, y0] = solve(a.y, b.y, c.y);
    context.save();
    context.beginPath();
    context.moveTo(...grown(a));
    context.lineTo(...grown(b));
    context.lineTo(...grown(c));
    context.clip();
    const from = Math.floor(Math.min(a.u, b.u, c.u) - 0.002), to = Math.floor(Math.max(a.u, b.u, c.u) + 0.002);
    for (let turn = from; turn <= to; ++turn) {
      context.setTransform(xu / w, yu / w, xv / h, yv / h, x0 + xu * turn, y0 + yu * turn);
      context.drawImage(source, -kMargin, 0);
    }
    context.restore();
  }

  function draw() {
    const w = picture.naturalWidth, h = picture.naturalHeight;
    if (!w) return;
    const grid = [];
    for (let j = 0; j <= kRows; ++j)
      for (let i = 0; i <= kColumns; ++i) {
        const x = i / kColumns, y = j / kRows;
        grid.push({...position(2 * x - 1, 1 - 2 * y), x: x * canvas.width, y: y * canvas.height});
      }
    // Across the seam of the picture u goes on, so that a cell's corners stay together.
    const near = (p, q) => ({...p, u: p.u - Math.round(p.u - q.u)});
    for (let j = 0; j < kRows; ++j)
      for (let i = 0; i < kColumns; ++i) {
        const at = j * (kColumns + 1) + i, a = grid[at];
        const b = near(grid[at + 1], a), c = near(grid[at + kColumns + 1], a), d = near(grid[at + kColumns + 2], a);
        triangle(a, b, c, w, h);
        triangle(b, d, c, w, h);
      }
    canvas.setAttribute("aria-label", `Looking ${compass(view.azimuth)}, ${upward(view.elevation, " degrees")}. Arrow keys turn, plus and minus zoom.`);
    canvas.dispatchEvent(new CustomEvent("turned", {detail: view}));
  }
  let asked = 0;
  const redraw = () => { if (!asked) asked = requestAnimationFrame(() => { asked = 0; draw(); }); };
  const turn = (azimuth, elevation) => {
    view.azimuth = (view.azimuth + azimuth + 360) % 360;
    view.elevation = Math.max(-89, Math.min(89, view.elevation + elevation));
    redraw();
  };
  const zoom = factor => { view.fov = Math.max(20, Math.min(110, view.fov * factor)); redraw(); };

  let last = null;
  canvas.addEventListener("pointerdown", e => { last = e; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener("pointermove", e => {
    if (!last) return;
    const scale = view.fov / canvas.clientWidth;
    turn((last.clientX - e.clientX) * scale, (e.clientY - last.clientY) * scale);
    last = e;
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { last = null; });
  canvas.addEventListener("wheel", e => { e.preventDefault(); zoom(e.deltaY > 0 ? 1.1 : 1 / 1.1); }, {passive: false});
  canvas.addEventListener("keydown", e => {
    const turns = {ArrowLeft: [-6, 0], ArrowRight: [6, 0], ArrowUp: [0, 6], ArrowDown: [0, -6]}[e.key];
    if (turns) turn(...turns);
    else if (e.key === "+" || e.key === "=") zoom(1 / 1.15);
    else if (e.key === "-") zoom(1.15);
    else return;
    e.preventDefault();
    e.stopPropagation();
  });
  if (picture.complete && picture.naturalWidth) load();
  picture.addEventListener("load", load);
  return view;
}

function compass(azimuth) {
  return ["north", "north-east", "east", "south-east", "south", "south-west", "west", "north-west"][Math.round(azimuth / 45) % 8];
}

function upward(elevation, unit) {
  return Math.abs(Math.round(elevation)) + unit + (Math.round(elevation) < 0 ? " down" : " up");
}
