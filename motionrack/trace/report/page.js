// Pointer, keys, the time bar and the tables.
const lineAt = (time) => { const move = moveAt(time); return move >= 0 ? moves[move][0] : 0; };

// The edge nearest to a place on the canvas: its last point and how far along it (0 .. 1); null if none is near.
const nearestEdge = (points, x, y, kinds) => {
  let best = 24 * 24, edge = null;
  for (let i = 1; i < points.length; ++i) {
    if (kinds && Math.round(kinds[i]) === 2) continue;
    const [ax, ay] = points[i - 1], [bx, by] = points[i];
    const dx = bx - ax, dy = by - ay, length = dx * dx + dy * dy;
    const along = length > 0 ? clamp(((x - ax) * dx + (y - ay) * dy) / length, 0, 1) : 0;
    const apart = (ax + along * dx - x) ** 2 + (ay + along * dy - y) ** 2;
    if (apart < best) { best = apart; edge = { i, along }; }
  }
  return edge;
};
const between = (row, { i, along }) => row[i - 1] + along * (row[i] - row[i - 1]);

// Says which line made the place under the pointer, and where and when it is; puts the cursor there.
const pointAt = (view, at) => {
  const edge = nearestEdge(view.points, at.x, at.y), plan = nearestEdge(view.plannedPoints, at.x, at.y, planned.kind);
  view.tip.hidden = !edge && !plan;
  if (view.tip.hidden) return;
  const path = edge ? driven : planned, time = edge ? between(driven.t, edge) : null;
  const line = (edge && lineAt(time)) || (plan ? Math.round(planned.line[plan.i]) : 0);
  const words = [(line > 0 ? "Line " + line + "   " : "") + (edge ? shownTime(time) : "programmed"),
    ["x", "y", "z"].map((name) => name.toUpperCase() + " " + shownNumber(between(path[name], edge || plan))).join("  ")];
  if (edge) words.push(shownNumber(edgeVelocity[edge.i]) + " mm/s");
  view.tip.textContent = words.join("\n");
  if (edge) setTime(time);
  const left = at.x + 220 > view.canvas.clientWidth;
  view.tip.style.left = left ? "" : at.x + 16 + "px";
  view.tip.style.right = left ? view.canvas.clientWidth - at.x + 16 + "px" : "";
  view.tip.style.top = clamp(at.y - 20, 0, view.canvas.clientHeight - 66) + "px";
};

const zoomPath = (view, factor, x, y) => {
  const look = view.look, zoom = clamp(look.zoom * factor, 0.2, 2000), real = zoom / look.zoom;
  const fromX = x - view.canvas.clientWidth / 2, fromY = y - view.canvas.clientHeight / 2;
  look.shiftX = fromX - (fromX - look.shiftX) * real;
  look.shiftY = fromY - (fromY - look.shiftY) * real;
  look.zoom = zoom;
  repaint();
};
const movePath = (view, dx, dy, shifted) => {
  if (view.kind === "plan" || shifted) { view.look.shiftX += dx; view.look.shiftY += dy; } else {
    view.look.yaw += dx * 0.008;
    view.look.tilt = clamp(view.look.tilt + dy * 0.008, -1.57, 1.57);
  }
  repaint();
};

const listenToPath = (view) => {
  const { canvas } = view, fingers = new Map();
  let spread = 0;
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); fingers.set(event.pointerId, place(event, canvas)); spread = 0; view.tip.hidden = true; });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event, canvas), before = fingers.get(event.pointerId);
    if (!before) {
      pointAt(view, at);
      return;
    }
    fingers.set(event.pointerId, at);
    if (fingers.size === 1) { movePath(view, at.x - before.x, at.y - before.y, event.shiftKey); return; }
    const [a, b] = [...fingers.values()], now = Math.hypot(a.x - b.x, a.y - b.y);
    if (spread > 0) zoomPath(view, now / spread, (a.x + b.x) / 2, (a.y + b.y) / 2);
    spread = now;
  });
  for (const over of ["pointerup", "pointercancel"]) canvas.addEventListener(over, (event) => { fingers.delete(event.pointerId); spread = 0; });
  canvas.addEventListener("pointerleave", () => { view.tip.hidden = true; });
  canvas.addEventListener("dblclick", () => { view.look = start(); repaint(); });
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    const at = place(event, canvas);
    zoomPath(view, Math.exp(-clamp(event.deltaY, -200, 200) * 0.002), at.x, at.y);
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-24, 0], ArrowRight: [24, 0], ArrowUp: [0, -24], ArrowDown: [0, 24] }[event.key];
    const middle = [canvas.clientWidth / 2, canvas.clientHeight / 2];
    if (step) movePath(view, ...step, event.shiftKey);
    else if (event.key === "+" || event.key === "=") zoomPath(view, 1.25, ...middle);
    else if (event.key === "-") zoomPath(view, 0.8, ...middle);
    else if (event.key === "0" || event.key === "Escape") { view.look = start(); repaint(); } else return;
    event.preventDefault();
  });
};

if (!document.getElementById("path").hidden) {
  const views = [...document.querySelectorAll("figure.view")].map((figure) => {
    const plot = figure.querySelector(".plot"), kind = figure.dataset.view;
    const tip = document.createElement("div");
    tip.className = "tip";
    tip.hidden = true;
    const view = { kind, look: start(), points: [], plannedPoints: [], output: figure.querySelector("output"), tip,
      canvas: canvasIn(plot, kind === "plan" ? "The path from above, programmed and driven" : "The path in perspective, programmed and driven") };
    plot.appendChild(tip);
    listenToPath(view);
    return view;
  });
  painters.push(() => { const colours = palette(); views.forEach((view) => drawPath(view, colours)); });
  const off = Math.max(drawing.driven.within, drawing.planned.within), known = Math.min(drawing.driven.within, drawing.planned.within) >= 0;
  document.getElementById("within").textContent = known ? "The lines drawn lie within " + Number(off.toPrecision(1)) + " mm of the recorded ones." : "The lines drawn are coarse: the path has too many corners for this page.";
  document.querySelector("#path .tools").hidden = driven.t.length < 2;
  document.getElementById("slow").textContent = "0";
  document.getElementById("fast").textContent = shownNumber(topEdgeVelocity) + " mm/s";
  document.getElementById("by-velocity").addEventListener("change", (event) => {
    state.byVelocity = event.target.checked;
    document.getElementById("velocity-scale").hidden = !state.byVelocity;
    repaint();
  });
}

// The time bar: the cursor by hand, and the run played back in its own time (long runs in twenty seconds).
const bar = { time: document.getElementById("time"), text: document.getElementById("time-text"), play: document.getElementById("play"), reset: document.getElementById("reset") };
let playing = false;
const play = (on) => {
  playing = on;
  bar.play.textContent = on ? "Pause" : "Play";
  bar.play.setAttribute("aria-label", on ? "Pause" : "Play");
  if (!on) return;
  if (state.time === null || state.time >= state.to || state.time < state.from) setTime(state.from);
  const pace = Math.max(1, (whole.to - whole.from) / 20) * (state.to - state.from) / (whole.to - whole.from);
  let last = performance.now();
  const next = (now) => {
    if (!playing) return;
    setTime(state.time + (now - last) / 1000 * pace);
    last = now;
    if (state.time >= state.to) play(false); else requestAnimationFrame(next);
  };
  requestAnimationFrame(next);
};
if (allTimes.length > 0) {
  document.getElementById("time-bar").hidden = false;
  bar.time.addEventListener("input", () => { play(false); setTime(whole.from + bar.time.value / 1000 * (whole.to - whole.from)); });
  bar.play.addEventListener("click", () => play(!playing));
  bar.reset.addEventListener("click", seeAll);
  painters.push(() => {
    if (state.time !== null) bar.time.value = (state.time - whole.from) / (whole.to - whole.from) * 1000;
    bar.text.textContent = state.time === null ? "" : shownTime(state.time);
    bar.reset.hidden = state.from === whole.from && state.to === whole.to;
  });
}

// Pointing at a move shows it in the path and in the charts; a click, or Enter, puts the cursor to its start.
// Up and down go from row to row.
const rows = [...document.querySelectorAll("tr[data-move], tr[data-time]")];
for (const row of rows) {
  const move = row.dataset.move === undefined ? -1 : Number(row.dataset.move);
  const show = (on) => { if (move >= 0) { state.move = on ? move : -1; repaint(); } };
  row.tabIndex = row.previousElementSibling ? -1 : 0;
  row.addEventListener("pointerenter", () => show(true));
  row.addEventListener("pointerleave", () => show(false));
  row.addEventListener("focus", () => show(true));
  row.addEventListener("blur", () => show(false));
  const jump = () => setTime(move >= 0 ? moves[move][1] : Number(row.dataset.time));
  row.addEventListener("click", jump);
  row.addEventListener("keydown", (event) => {
    const next = event.key === "ArrowDown" ? row.nextElementSibling : event.key === "ArrowUp" ? row.previousElementSibling : null;
    if (event.key === "Enter") jump();
    if (!next) return;
    row.tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
    event.preventDefault();
  });
}

document.documentElement.classList.add("scripted-on");
document.querySelectorAll(".scripted").forEach((hint) => { hint.hidden = false; });
new ResizeObserver(repaint).observe(document.body);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", repaint);
repaint();
