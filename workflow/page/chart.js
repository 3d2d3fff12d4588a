"use strict";
/* The interactive Figure 2: mean curves of vt/h over X, drawn by uPlot. Its data are in the element #curves. */

(function () {
  const data = JSON.parse(document.getElementById("curves").textContent);
  const place = document.getElementById("chart");
  const readout = document.getElementById("chart-readout");
  const values = (name) => [...new Set(data.curves.map((curve) => curve[name]))];
  const off = { hurst: new Set(), combination: new Set() };
  let estimated = null; // the estimate of the calculator, {x, velocity}
  let shown = null; // the curve under the pointer

  const raised = (number) =>
    [...String(number)].map((sign) => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign])).join("");
  const digits = (number) =>
    number >= 1e-3 && number < 1e5
      ? String(Number(number.toPrecision(3)))
      : number.toExponential(2).replace(/e([+-]\d+)$/, (_, power) => `×10${raised(Number(power))}`);
  /** The force, viscosity, diameter and rms height of a curve, as text. */
  const combination = ({ force, viscosity, diameter, rms }) =>
    `F = ${digits(force)} N, η = ${digits(viscosity)} Pa s, L = ${digits(1e3 * diameter)} mm, h = ${digits(1e6 * rms)} µm`;
  const power = (value) => Math.round(Math.log10(value));
  const isPower = (value) => Math.abs(Math.log10(value) - power(value)) < 1e-6;
  const narrow = () => place.clientWidth < 450; // pixels; every second label has room
  const onlyPowers = (self, splits) => splits.map((value) => (isPower(value) ? value : null));
  const powers = (self, splits) => splits.map((value) => (value === null || (narrow() && power(value) % 2) ? "" : `10${raised(power(value))}`));

  /** Write the values of the curve that is nearest to the pointer. */
  function point(self) {
    const { idx, top } = self.cursor;
    let nearest = null;
    if (idx !== null && idx !== undefined && top >= 0) {
      let least = 40; // pixels
      data.curves.forEach((curve, i) => {
        const velocity = curve.velocity[idx];
        if (!self.series[i + 1].show || velocity === null) return;
        const distance = Math.abs(self.valToPos(velocity, "y") - top);
        if (distance < least) [least, nearest] = [distance, i];
      });
    }
    if (nearest !== shown) {
      shown = nearest;
      self.redraw(false);
    }
    if (nearest === null) {
      readout.textContent = "Point at a curve to read its values.";
      return;
    }
    const curve = data.curves[nearest];
    const time = (4 * data.x[idx] * curve.viscosity * curve.rms * curve.diameter) / curve.force;
    const velocity = (curve.velocity[idx] * curve.rms) / time;
    readout.textContent =
      `H = ${curve.hurst}, ${combination(curve)}: after ${digits(time)} s, ${digits(1e6 * velocity)} µm/s, ` +
      `${digits(curve.elements[idx])} elements in contact (median); X = ${digits(data.x[idx])}, ` +
      `vt/h = ${digits(curve.velocity[idx])}`;
  }

  /** Draw the two limits, and write the Hurst exponents beside the curves, where they lie farthest apart. */
  function label(self) {
    const { ctx } = self;
    const { left, top, width, height } = self.bbox;
    const ratio = devicePixelRatio;
    const at = (x, y) => [self.valToPos(x, "x", true), self.valToPos(y, "y", true)];
    const write = (text, x, y, color) => {
      ctx.lineWidth = 4 * ratio;
      ctx.strokeStyle = "#ffffff";
      ctx.strokeText(text, x, y);
      ctx.fillStyle = color;
      ctx.fillText(text, x, y);
    };
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.font = `${14 * ratio}px system-ui, "DejaVu Sans", sans-serif`;
    ctx.textBaseline = "middle";
    data.limits.forEach((limit, i) => {
      ctx.beginPath();
      for (const x of [self.scales.x.min, self.scales.x.max]) ctx.lineTo(...at(x, x * limit.ratio));
      ctx.setLineDash([6 * ratio, 5 * ratio]);
      ctx.lineWidth = 1.2 * ratio;
      ctx.strokeStyle = "#5a6675";
      ctx.stroke();
      ctx.setLineDash([]);
      const y = top + (i ? 0.5 : 0.12) * height; // the first label stands left of its line, the second right of it
      const x = self.valToPos(self.posToVal((y - top) / ratio, "y") / limit.ratio, "x", true);
      ctx.textAlign = i ? "left" : "right";
      const text = narrow() ? limit.label.replace(" in contact", "") : limit.label;
      write(text, x + (i ? 10 : -10) * ratio, y, "#4d5562");
    });
    const first = values("hurst").map((hurst) => data.curves.findIndex((c, i) => c.hurst === hurst && self.series[i + 1].show));
    const drawn = first.filter((i) => i >= 0);
    const spread = data.x.map((x, k) => {
      const logs = drawn.map((i) => data.curves[i].velocity[k]).filter((v) => v !== null).map(Math.log);
      return logs.length < drawn.length ? -1 : Math.max(...logs) - Math.min(...logs);
    });
    const widest = drawn.length > 1 ? spread.indexOf(Math.max(...spread)) : Math.round(data.x.length / 2);
    const upper = Math.ceil(drawn.length / 2);
    const step = 20 * ratio;
    drawn.forEach((i, place) => {
      const curve = data.curves[i];
      if (curve.velocity[widest] === null) return;
      const above = place < upper;
      const [x, y] = at(data.x[widest], curve.velocity[widest]);
      const rank = above ? upper - place : place - upper + 1; // 1 for the labels next to the curves
      const [, edge] = at(data.x[widest], data.curves[drawn[above ? 0 : drawn.length - 1]].velocity[widest]);
      const height = edge + (above ? -1 : 1) * (30 * ratio + (rank - 1) * step);
      const kind = narrow() ? "" : place === 0 ? ", rugged" : place === drawn.length - 1 ? ", smooth" : "";
      const text = `H = ${curve.hurst}${kind}`;
      const room = left + ctx.measureText(text).width + 8 * ratio; // a label does not leave the chart
      const end = above ? Math.max(room, x - 34 * ratio) : x + 34 * ratio;
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(end, height);
      ctx.lineWidth = ratio;
      ctx.strokeStyle = curve.color;
      ctx.stroke();
      ctx.textAlign = above ? "right" : "left";
      write(text, end + (above ? -4 : 4) * ratio, height, "#1c2430");
    });
    ctx.restore();
  }

  /** Draw the curve under the pointer thicker, and the estimate of the calculator as a ring. */
  function mark(self) {
    const { ctx } = self;
    ctx.save();
    if (shown !== null && self.series[shown + 1].show) {
      ctx.beginPath();
      let drawing = false;
      data.curves[shown].velocity.forEach((velocity, i) => {
        const inside = velocity !== null && data.x[i] >= self.scales.x.min && data.x[i] <= self.scales.x.max;
        if (inside) {
          const at = [self.valToPos(data.x[i], "x", true), self.valToPos(velocity, "y", true)];
          if (drawing) ctx.lineTo(...at);
          else ctx.moveTo(...at);
        }
        drawing = inside;
      });
      ctx.lineWidth = 3.5 * devicePixelRatio;
      ctx.strokeStyle = data.curves[shown].color;
      ctx.stroke();
    }
    if (estimated) {
      const [x, y] = [self.valToPos(estimated.x, "x", true), self.valToPos(estimated.velocity, "y", true)];
      const { left, top, width, height } = self.bbox;
      if (x >= left && x <= left + width && y >= top && y <= top + height) {
        ctx.beginPath();
        ctx.arc(x, y, 6 * devicePixelRatio, 0, 2 * Math.PI);
        ctx.fillStyle = "#ffffff";
        ctx.fill();
        ctx.lineWidth = 3 * devicePixelRatio;
        ctx.strokeStyle = "#d55e00";
        ctx.stroke();
      }
    }
    ctx.restore();
  }

  const size = () => ({
    width: place.clientWidth,
    height: Math.round(Math.min(430, Math.max(340, 0.6 * place.clientWidth))),
  });
  const axis = (label) => ({
    label,
    labelFont: "14px system-ui, sans-serif",
    font: "13px system-ui, sans-serif",
    stroke: "#1c2430",
    grid: { stroke: "#e4e8ee", width: 1, filter: onlyPowers },
    ticks: { stroke: "#9aa4b1", width: 1, filter: onlyPowers },
    filter: onlyPowers,
    values: powers,
  });
  const plot = new uPlot(
    {
      ...size(),
      legend: { show: false },
      cursor: { drag: { setScale: false }, points: { show: false } },
      scales: { x: { time: false, distr: 3 }, y: { distr: 3 } },
      axes: [axis("scaled time, X = Ft/(4ηhL)"), { ...axis("scaled velocity, vt/h"), size: 58 }],
      series: [{}, ...data.curves.map((curve) => ({ stroke: curve.color, width: 1.2, points: { show: false } }))],
      hooks: { setCursor: [point], draw: [label, mark] },
    },
    [data.x, ...data.curves.map((curve) => curve.velocity)],
    place,
  );

  /** Add a button for each value of a property, which switches its curves on and off. */
  function switches(property, label) {
    const group = document.createElement("div");
    group.className = "switches";
    group.append(label);
    for (const value of values(property)) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = property === "hurst" ? value : value.replace(/^c/, "");
      button.setAttribute("aria-pressed", "true");
      if (property === "combination") button.title = combination(data.curves.find((curve) => curve.combination === value));
      if (property === "hurst") {
        button.style.borderColor = data.curves.find((curve) => curve.hurst === value).color;
      }
      button.addEventListener("click", () => {
        const isOn = button.getAttribute("aria-pressed") === "true";
        button.setAttribute("aria-pressed", String(!isOn));
        if (isOn) off[property].add(value);
        else off[property].delete(value);
        plot.batch(() => {
          data.curves.forEach((curve, i) => {
            const show = !off.hurst.has(curve.hurst) && !off.combination.has(curve.combination);
            plot.setSeries(i + 1, { show });
          });
        });
      });
      group.append(button);
    }
    return group;
  }

  document.getElementById("chart-switches").append(switches("hurst", "H:"), switches("combination", "choices of F, η, L, h:"));
  document.getElementById("interactive").classList.add("ready");
  plot.setSize(size());
  window.addEventListener("resize", () => plot.setSize(size()));
  document.addEventListener("estimate", (event) => {
    estimated = event.detail;
    plot.redraw(false);
  });
  readout.textContent = "Point at a curve to read its values.";
})();
