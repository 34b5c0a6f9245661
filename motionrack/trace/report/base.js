// What all parts of the page share: the run's numbers, the cursor's time, the zoom over time, colours, small helpers.
const drawing = JSON.parse(document.getElementById("drawing").textContent);

const unpack = (packed) => {
  const out = new Float64Array(packed.d.length);
  let sum = 0;
  packed.d.forEach((step, i) => { sum += step; out[i] = packed.from + packed.step * sum; });
  return out;
};
const charts = drawing.charts.map((chart) => ({ ...chart, t: unpack(chart.t), v: unpack(chart.v) }));
const driven = { x: unpack(drawing.driven.x), y: unpack(drawing.driven.y), z: unpack(drawing.driven.z), t: unpack(drawing.driven.t) };
const planned = {
  x: unpack(drawing.planned.x), y: unpack(drawing.planned.y), z: unpack(drawing.planned.z),
  line: unpack(drawing.planned.line), kind: unpack(drawing.planned.kind),
};
const moves = drawing.moves;

const allTimes = [...charts.map((chart) => chart.t), driven.t].filter((t) => t.length > 0);
const whole = {
  from: allTimes.length ? Math.min(...allTimes.map((t) => t[0])) : 0,
  to: allTimes.length ? Math.max(...allTimes.map((t) => t[t.length - 1])) : 1,
};
if (!(whole.to > whole.from)) whole.to = whole.from + 1;

// time: the cursor, null = none; from, to: what the charts show; move: the move pointed at, -1 = none.
const state = { time: null, from: whole.from, to: whole.to, move: -1, byVelocity: false };
const painters = [];
let asked = false;
const repaint = () => {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; painters.forEach((paint) => paint()); });
};
const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
const setTime = (time) => { state.time = time === null ? null : clamp(time, whole.from, whole.to); repaint(); };
const setView = (from, to) => {
  const least = (whole.to - whole.from) * 1e-5;
  if (to - from < least) { const middle = (from + to) / 2; from = middle - least / 2; to = middle + least / 2; }
  const span = Math.min(to - from, whole.to - whole.from);
  state.from = clamp(from, whole.from, whole.to - span);
  state.to = state.from + span;
  repaint();
};
const zoomTime = (factor, about) => setView(about - (about - state.from) * factor, about + (state.to - about) * factor);
const seeAll = () => setView(whole.from, whole.to);

// The last index whose value is not above `value`; -1 if there is none. `row` never falls.
const indexAt = (row, value) => {
  let low = 0, high = row.length;
  while (low < high) { const middle = (low + high) >> 1; if (row[middle] <= value) low = middle + 1; else high = middle; }
  return low - 1;
};
const valueAt = (times, values, time) => {
  if (times.length === 0) return NaN;
  const i = indexAt(times, time);
  if (i < 0) return values[0];
  if (i >= times.length - 1) return values[times.length - 1];
  const span = times[i + 1] - times[i];
  return span > 0 ? values[i] + (values[i + 1] - values[i]) * (time - times[i]) / span : values[i];
};
const drivenAt = (time) => [valueAt(driven.t, driven.x, time), valueAt(driven.t, driven.y, time), valueAt(driven.t, driven.z, time)];

const niceStep = (span, parts) => {
  const rough = span / Math.max(1, parts);
  const power = 10 ** Math.floor(Math.log10(rough));
  const factor = [1, 2, 5, 10].find((f) => power * f >= rough * 0.999);
  return power * factor;
};
const ticks = (from, to, parts) => {
  const step = niceStep(to - from, parts), out = [];
  if (!(step > 0)) return out;
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + step * 1e-9 && out.length < 200; ++k) {
    out.push({ value: k * step, text: (k * step).toFixed(clamp(-Math.floor(Math.log10(step) + 1e-9), 0, 9)).replace(/^-(0\.?0*)$/, "$1") });
  }
  return out;
};
const shownNumber = (value) => {
  if (!Number.isFinite(value)) return "\u2013";
  const size = Math.abs(value);
  return value.toFixed(size >= 1000 ? 1 : size >= 100 ? 2 : size >= 1 ? 3 : 4).replace("-", "\u2212");
};
const shownTime = (time) => time.toFixed(whole.to - whole.from > 100 ? 3 : 4) + " s";

// A colour of the style sheet; read again for each picture, so that a change from light to dark is followed.
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
const palette = () => Object.fromEntries(["card", "ink", "soft", "grid", "rule", "accent", "good", "wrong", "planned", "driven",
  "box", "hot", "x", "y", "z", "a", "b", "c", "d"].map((name) => [name, colour(name)]));

// A canvas in place of the static picture: sharp on every screen, as wide as its place.
const canvasIn = (plot, label) => {
  const canvas = document.createElement("canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", label);
  plot.appendChild(canvas);
  return canvas;
};
const prepared = (canvas) => {
  const ratio = Math.min(3, window.devicePixelRatio || 1);
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "11px system-ui, sans-serif";
  return { pen, width, height };
};
const place = (event, canvas) => {
  const box = canvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
};
const moveAt = (time) => {
  let low = 0, high = moves.length;
  while (low < high) { const middle = (low + high) >> 1; if (moves[middle][1] <= time) low = middle + 1; else high = middle; }
  return low > 0 && time <= moves[low - 1][2] ? low - 1 : -1;
};
