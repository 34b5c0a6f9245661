// The path, from above and in perspective: programmed (wide and pale) under driven (thin and dark).
const [frameLow, frameHigh] = drawing.frame;
const [travelLow, travelHigh] = drawing.travel;
const frameMiddle = frameLow.map((low, i) => (low + frameHigh[i]) / 2);
const frameSize = Math.max(1e-6, Math.hypot(...frameLow.map((low, i) => frameHigh[i] - low)));

// Velocity along each driven edge, and the colour for it: slow is blue, fast is orange.
const edgeVelocity = new Float64Array(driven.t.length);
let topEdgeVelocity = 0;
for (let i = 1; i < driven.t.length; ++i) {
  const span = driven.t[i] - driven.t[i - 1];
  edgeVelocity[i] = span > 0 ? Math.hypot(driven.x[i] - driven.x[i - 1], driven.y[i] - driven.y[i - 1], driven.z[i] - driven.z[i - 1]) / span : 0;
  topEdgeVelocity = Math.max(topEdgeVelocity, edgeVelocity[i]);
}
const shades = 24;
const shadeOf = (velocity) => topEdgeVelocity > 0 ? Math.min(shades - 1, Math.floor(velocity / topEdgeVelocity * shades)) : 0;
const shade = (k) => `hsl(${225 - 210 * k / (shades - 1)} 75% 48%)`;

const start = () => ({ yaw: -0.61, tilt: 0.55, zoom: 1, shiftX: 0, shiftY: 0 });

// Half the width and height of the frame in perspective as it first stands, so that turning it does not change its size.
const standing = (() => {
  const { yaw, tilt } = start(), size = [0, 0];
  for (let bits = 0; bits < 8; ++bits) {
    const [x, y, z] = [0, 1, 2].map((i) => (frameHigh[i] - frameLow[i]) / 2 * (bits >> i & 1 ? 1 : -1));
    const deep = x * Math.sin(yaw) + y * Math.cos(yaw);
    const shrink = frameSize * 2 / (frameSize * 2 + deep * Math.cos(tilt) - z * Math.sin(tilt));
    size[0] = Math.max(size[0], Math.abs(x * Math.cos(yaw) - y * Math.sin(yaw)) * shrink);
    size[1] = Math.max(size[1], Math.abs(z * Math.cos(tilt) + deep * Math.sin(tilt)) * shrink);
  }
  return size;
})();
// The height of the ground: the lowest point of the paths.
const floor = Math.min(...[planned.z, driven.z].map((row) => row.length ? row.reduce((a, b) => Math.min(a, b)) : Infinity));

const projector = (view, width, height) => {
  const { yaw, tilt, zoom, shiftX, shiftY } = view.look;
  const plan = view.kind === "plan", far = frameSize * 2;
  const cy = Math.cos(yaw), sy = Math.sin(yaw), ct = Math.cos(tilt), st = Math.sin(tilt);
  const flat = (px, py, pz) => {
    const x = px - frameMiddle[0], y = py - frameMiddle[1], z = pz - frameMiddle[2];
    if (plan) return [x, y];
    const deep = x * sy + y * cy;
    const shrink = far / Math.max(far * 0.05, far + deep * ct - z * st);
    return [(x * cy - y * sy) * shrink, (z * ct + deep * st) * shrink];
  };
  let across = 1e-9, up = 1e-9;
  if (plan) { across = (frameHigh[0] - frameLow[0]) / 2; up = (frameHigh[1] - frameLow[1]) / 2; } else { [across, up] = standing; }
  const scale = Math.min((width / 2 - 34) / Math.max(across, 1e-9), (height / 2 - 26) / Math.max(up, 1e-9)) * zoom;
  const to = (px, py, pz) => { const [a, b] = flat(px, py, pz); return [width / 2 + shiftX + a * scale, height / 2 + shiftY - b * scale]; };
  to.scale = scale;
  return to;
};

const trace = (pen, points) => { points.forEach(([x, y], i) => { if (i === 0) pen.moveTo(x, y); else pen.lineTo(x, y); }); };

const drawGround = (pen, view, to, width, height, colours) => {
  pen.lineWidth = 1;
  pen.strokeStyle = colours.grid;
  pen.fillStyle = colours.soft;
  if (view.kind === "plan") {
    const reachX = [(0 - width / 2 - view.look.shiftX) / to.scale + frameMiddle[0], (width / 2 - view.look.shiftX) / to.scale + frameMiddle[0]];
    const reachY = [frameMiddle[1] - (height / 2 - view.look.shiftY) / to.scale, frameMiddle[1] + (height / 2 + view.look.shiftY) / to.scale];
    pen.beginPath();
    pen.textAlign = "center";
    for (const tick of ticks(...reachX, width / 90)) {
      const [x] = to(tick.value, 0, 0);
      pen.moveTo(Math.round(x) + 0.5, 0); pen.lineTo(Math.round(x) + 0.5, height);
      if (x > 40 && x < width - 44) pen.fillText(tick.text.replace("-", "\u2212"), x, height - 5);
    }
    pen.textAlign = "left";
    for (const tick of ticks(...reachY, width / 90)) {
      const [, y] = to(0, tick.value, 0);
      pen.moveTo(0, Math.round(y) + 0.5); pen.lineTo(width, Math.round(y) + 0.5);
      if (y > 24 && y < height - 16) pen.fillText(tick.text.replace("-", "\u2212"), 4, y - 3);
    }
    pen.stroke();
    pen.fillText("Y, mm", 4, 12);
    pen.textAlign = "right";
    pen.fillText("X, mm", width - 4, height - 5);
  } else {
    pen.beginPath();
    for (const [i, other] of [[0, 1], [1, 0]]) {
      for (const tick of ticks(frameLow[i], frameHigh[i], 8)) {
        const from = [frameLow[0], frameLow[1], floor], end = [...from];
        from[i] = end[i] = tick.value;
        end[other] = frameHigh[other];
        trace(pen, [to(...from), to(...end)]);
      }
    }
    pen.stroke();
    drawTripod(pen, view, height, colours);
  }
  const corner = (bits) => to(...[0, 1, 2].map((i) => (bits >> i & 1 ? travelHigh : travelLow)[i]));
  pen.strokeStyle = colours.box;
  pen.setLineDash([2, 4]);
  pen.beginPath();
  for (let from = 0; from < (view.kind === "plan" ? 4 : 8); ++from) {
    for (const bit of view.kind === "plan" ? [1, 2] : [1, 2, 4]) if (!(from & bit)) trace(pen, [corner(from), corner(from | bit)]);
  }
  pen.stroke();
  pen.setLineDash([]);
};

// Which way X, Y and Z point, in the corner of the perspective view.
const drawTripod = (pen, view, height, colours) => {
  const { yaw, tilt } = view.look;
  const arms = [["X", Math.cos(yaw), Math.sin(yaw) * Math.sin(tilt), colours.x],
    ["Y", -Math.sin(yaw), Math.cos(yaw) * Math.sin(tilt), colours.y], ["Z", 0, Math.cos(tilt), colours.z]];
  pen.textAlign = "center";
  for (const [name, dx, dy, ink] of arms) {
    pen.strokeStyle = pen.fillStyle = ink;
    pen.lineWidth = 2;
    pen.beginPath();
    pen.moveTo(42, height - 36);
    pen.lineTo(42 + dx * 24, height - 36 - dy * 24);
    pen.stroke();
    pen.fillText(name, 42 + dx * 33, height - 32 - dy * 33);
  }
  pen.lineWidth = 1;
};

const drawPlanned = (pen, view, to, colours) => {
  const points = view.plannedPoints = Array.from(planned.x, (_, i) => to(planned.x[i], planned.y[i], planned.z[i]));
  for (const traverse of [0, 1]) {
    pen.strokeStyle = colours.planned;
    pen.lineWidth = 5;
    pen.lineCap = traverse ? "butt" : "round";
    pen.lineJoin = "round";
    pen.setLineDash(traverse ? [7, 7] : []);
    pen.beginPath();
    let joined = false;
    for (let i = 1; i < planned.x.length; ++i) {
      if (Math.round(planned.kind[i]) !== traverse) { joined = false; continue; }
      if (!joined) pen.moveTo(...points[i - 1]);
      pen.lineTo(...points[i]);
      joined = true;
    }
    pen.stroke();
  }
  pen.setLineDash([]);
};

const drawDriven = (pen, view, to, colours) => {
  const points = view.points = driven.t.length ? Array.from(driven.t, (_, i) => to(driven.x[i], driven.y[i], driven.z[i])) : [];
  pen.lineJoin = pen.lineCap = "round";
  pen.lineWidth = state.byVelocity ? 2.5 : 1.5;
  if (state.byVelocity) {
    const paths = Array.from({ length: shades }, () => new Path2D());
    for (let i = 1; i < points.length; ++i) {
      const path = paths[shadeOf(edgeVelocity[i])];
      path.moveTo(...points[i - 1]);
      path.lineTo(...points[i]);
    }
    paths.forEach((path, k) => { pen.strokeStyle = shade(k); pen.stroke(path); });
  } else {
    pen.strokeStyle = colours.driven;
    pen.beginPath();
    trace(pen, points);
    pen.stroke();
  }
  const span = state.move >= 0 ? moves[state.move] : state.from > whole.from || state.to < whole.to ? [0, state.from, state.to] : null;
  if (!span || points.length === 0) return;
  const inside = [to(...drivenAt(span[1]))];
  for (let i = indexAt(driven.t, span[1]) + 1; i < driven.t.length && driven.t[i] < span[2]; ++i) inside.push(points[i]);
  inside.push(to(...drivenAt(span[2])));
  pen.strokeStyle = colours.hot;
  pen.lineWidth = 4;
  pen.beginPath();
  trace(pen, inside);
  pen.stroke();
};

// The part (0 .. 1 each end) of the edge a b that lies in the picture; null if none does.
const insidePart = ([ax, ay], [bx, by], width, height) => {
  let from = 0, end = 1;
  for (const [at, step, size] of [[ax, bx - ax, width], [ay, by - ay, height]]) {
    if (step === 0) { if (at < 0 || at > size) return null; continue; }
    const [near, far] = step > 0 ? [-at / step, (size - at) / step] : [(size - at) / step, -at / step];
    from = Math.max(from, near);
    end = Math.min(end, far);
  }
  return from < end ? [from, end] : null;
};

// Arrows tell the way it was driven; about forty at most, so that they do not hide a dense path.
const drawArrows = (pen, points, width, height, colours) => {
  const parts = [];
  let run = 0, seen = 0;
  for (let i = 1; i < points.length; ++i) {
    const a = points[i - 1], b = points[i], length = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const part = length > 0 ? insidePart(a, b, width, height) : null;
    if (part) { parts.push([a, b, run, length, part]); seen += (part[1] - part[0]) * length; }
    run += length;
  }
  const apart = Math.max(90, seen / 40);
  pen.fillStyle = state.byVelocity ? colours.ink : colours.driven;
  pen.strokeStyle = colours.card;
  pen.lineWidth = 1;
  pen.beginPath();
  for (const [[ax, ay], [bx, by], before, length, part] of parts) {
    const ux = (bx - ax) / length, uy = (by - ay) / length;
    for (let k = Math.ceil((before + part[0] * length) / apart - 0.5); (k + 0.5) * apart < before + part[1] * length; ++k) {
      const along = (k + 0.5) * apart - before, x = ax + ux * along, y = ay + uy * along;
      pen.moveTo(x + 6 * ux, y + 6 * uy);
      pen.lineTo(x - 4 * ux - 4.5 * uy, y - 4 * uy + 4.5 * ux);
      pen.lineTo(x - 4 * ux + 4.5 * uy, y - 4 * uy - 4.5 * ux);
      pen.closePath();
    }
  }
  pen.fill();
  pen.stroke();
};

const drawStop = (pen, x, y, colours) => {
  pen.fillStyle = colours.wrong;
  pen.strokeStyle = colours.card;
  pen.lineWidth = 2;
  pen.beginPath();
  trace(pen, [[-4, -9], [4, -9], [9, -4], [9, 4], [4, 9], [-4, 9], [-9, 4], [-9, -4]].map(([dx, dy]) => [x + dx, y + dy]));
  pen.closePath();
  pen.fill();
  trace(pen, [[x - 5, y], [x + 5, y]]);
  pen.stroke();
};

const drawMarks = (pen, view, to, colours) => {
  pen.lineWidth = 1.5;
  pen.strokeStyle = colours.card;
  const last = view.points.length - 1;
  if (last >= 0) {
    const [sx, sy] = view.points[0], [ex, ey] = view.points[last];
    pen.fillStyle = colours.ink;
    pen.beginPath(); pen.rect(ex - 5, ey - 5, 10, 10); pen.fill(); pen.stroke();
    pen.fillStyle = colours.good;
    pen.beginPath(); pen.arc(sx, sy, 5, 0, 7); pen.fill(); pen.stroke();
  }
  pen.strokeStyle = colours.wrong;
  pen.lineWidth = 3;
  if (drawing.worst) {
    const [x, y] = to(...drawing.worst.at);
    pen.beginPath();
    trace(pen, [[x - 6, y - 6], [x + 6, y + 6]]);
    trace(pen, [[x - 6, y + 6], [x + 6, y - 6]]);
    pen.stroke();
  }
  if (drawing.stop) drawStop(pen, ...to(...drawing.stop.at), colours);
  if (state.time !== null && last >= 0) {
    const [x, y] = to(...drivenAt(state.time));
    pen.fillStyle = colours.hot;
    pen.strokeStyle = colours.card;
    pen.lineWidth = 2;
    pen.beginPath(); pen.arc(x, y, 6.5, 0, 7); pen.fill(); pen.stroke();
  }
};

const drawPath = (view, colours) => {
  const { pen, width, height } = prepared(view.canvas);
  if (width < 60) return;
  const to = projector(view, width, height);
  drawGround(pen, view, to, width, height, colours);
  drawPlanned(pen, view, to, colours);
  drawDriven(pen, view, to, colours);
  drawArrows(pen, view.points, width, height, colours);
  drawMarks(pen, view, to, colours);
  const point = state.time === null || driven.t.length === 0 ? null : drivenAt(state.time);
  view.output.textContent = point ? ["X", "Y", "Z"].map((name, i) => name + " " + shownNumber(point[i])).join("  ") : "";
};
