// Charts over time: one picture each, all with the same cursor and the same zoom.
const edge = { left: 56, right: 12, top: 8, bottom: 20 };

const drawScales = (pen, view, place, colours) => {
  const [low, high] = view.chart.range, { x, y, inner, deep, width, height } = place;
  pen.strokeStyle = colours.grid;
  pen.fillStyle = colours.soft;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.textAlign = "right";
  for (const tick of ticks(low, high, deep / 22)) {
    pen.moveTo(edge.left, Math.round(y(tick.value)) + 0.5);
    pen.lineTo(width - edge.right, Math.round(y(tick.value)) + 0.5);
    pen.fillText(tick.text.replace("-", "\u2212"), edge.left - 6, y(tick.value) + 4);
  }
  pen.textAlign = "center";
  for (const tick of ticks(state.from, state.to, inner / 80)) {
    pen.moveTo(Math.round(x(tick.value)) + 0.5, edge.top);
    pen.lineTo(Math.round(x(tick.value)) + 0.5, height - edge.bottom);
    pen.fillText(tick.text, clamp(x(tick.value), edge.left + 6, width - 14), height - 5);
  }
  pen.stroke();
};

const drawLimits = (pen, view, { y, width }, colours) => {
  pen.strokeStyle = colours.wrong;
  pen.setLineDash([6, 4]);
  pen.beginPath();
  for (const limit of view.chart.limits) { pen.moveTo(edge.left, y(limit)); pen.lineTo(width - edge.right, y(limit)); }
  pen.stroke();
  pen.setLineDash([]);
};

const drawSeries = (pen, view, { x, y }, colours) => {
  const { t, v, look } = view.chart;
  const first = Math.max(0, indexAt(t, state.from)), last = Math.min(t.length - 1, indexAt(t, state.to) + 1);
  pen.strokeStyle = colours[look] || colours.d;
  pen.lineWidth = 1.5;
  pen.lineJoin = "round";
  pen.beginPath();
  for (let i = first; i <= last; ++i) { if (i === first) pen.moveTo(x(t[i]), y(v[i])); else pen.lineTo(x(t[i]), y(v[i])); }
  pen.stroke();
};

const drawBand = (pen, from, to, deep, ink) => {
  pen.globalAlpha = 0.16;
  pen.fillStyle = ink;
  pen.fillRect(from, edge.top, to - from, deep);
  pen.globalAlpha = 1;
};

const drawCursor = (pen, view, { x, y, deep }, colours) => {
  view.output.textContent = "";
  if (state.time === null) return;
  const value = valueAt(view.chart.t, view.chart.v, state.time);
  pen.strokeStyle = pen.fillStyle = colours.ink;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(x(state.time), edge.top);
  pen.lineTo(x(state.time), edge.top + deep);
  pen.stroke();
  pen.beginPath();
  pen.arc(x(state.time), y(value), 3, 0, 7);
  pen.fill();
  view.output.textContent = shownNumber(value);
};

const drawChart = (view, colours) => {
  const { pen, width, height } = prepared(view.canvas);
  if (width < 80) return;
  const [low, high] = view.chart.range;
  const inner = width - edge.left - edge.right, deep = height - edge.top - edge.bottom;
  const x = (t) => edge.left + (t - state.from) / (state.to - state.from) * inner;
  const y = (v) => edge.top + deep - (v - low) / (high - low) * deep;
  const place = { x, y, inner, deep, width, height };
  drawScales(pen, view, place, colours);
  pen.save();
  pen.beginPath();
  pen.rect(edge.left, edge.top - 3, inner, deep + 6);
  pen.clip();
  const move = moves[state.move];
  if (move) drawBand(pen, x(move[1]), Math.max(x(move[1]) + 2, x(move[2])), deep, colours.hot);
  drawLimits(pen, view, place, colours);
  drawSeries(pen, view, place, colours);
  if (view.dragFrom !== null) drawBand(pen, Math.min(view.dragFrom, view.dragTo), Math.max(view.dragFrom, view.dragTo), deep, colours.accent);
  drawCursor(pen, view, place, colours);
  pen.restore();
};

const timeAt = (view, at) => {
  const inner = view.canvas.clientWidth - edge.left - edge.right;
  return state.from + clamp((at - edge.left) / inner, 0, 1) * (state.to - state.from);
};

const listenToChart = (view) => {
  const { canvas } = view;
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    view.dragFrom = view.dragTo = place(event, canvas).x;
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event, canvas).x;
    if (view.dragFrom !== null) view.dragTo = at;
    setTime(timeAt(view, at));
  });
  const drop = (zoom) => {
    const { dragFrom, dragTo } = view;
    view.dragFrom = null;
    if (zoom && dragFrom !== null && Math.abs(dragTo - dragFrom) > 5) {
      const a = timeAt(view, dragFrom), b = timeAt(view, dragTo);
      setView(Math.min(a, b), Math.max(a, b));
    }
    repaint();
  };
  canvas.addEventListener("pointerup", () => drop(true));
  canvas.addEventListener("pointercancel", () => drop(false));
  canvas.addEventListener("dblclick", seeAll);
  canvas.addEventListener("keydown", (event) => {
    const step = (state.to - state.from) / (event.shiftKey ? 20 : 200);
    const time = state.time === null ? state.from : state.time;
    if (event.key === "ArrowRight") setTime(time + step);
    else if (event.key === "ArrowLeft") setTime(time - step);
    else if (event.key === "+" || event.key === "=") zoomTime(0.5, time);
    else if (event.key === "-") zoomTime(2, time);
    else if (event.key === "0" || event.key === "Escape") seeAll();
    else return;
    if (state.time !== null && (state.time < state.from || state.time > state.to)) setView(state.time - (state.to - state.from) / 2, state.time + (state.to - state.from) / 2);
    event.preventDefault();
  });
};

const chartViews = [...document.querySelectorAll("figure.chart")].map((figure) => {
  const chart = charts[Number(figure.dataset.chart)];
  const view = {
    chart, canvas: canvasIn(figure.querySelector(".plot"), (chart.name === "" ? "" : "Axis " + chart.name + ": ") + chart.title + " over time"),
    output: figure.querySelector("output"), dragFrom: null, dragTo: 0,
  };
  listenToChart(view);
  return view;
});
painters.push(() => { const colours = palette(); chartViews.forEach((view) => drawChart(view, colours)); });
