"use strict";
/* The calculator of the page: the calibrated penetration law, as viscorough.estimates computes it for a Newtonian medium.
   Its numbers are in the element #law. Without a page, as in tests, it only defines functions. */

/** Numbers of the law for a Hurst exponent, interpolated linearly, abscissae X logarithmically. */
function penetrationLaw(table, hurst) {
  let place = 0;
  while (place < table.hurst.length - 2 && hurst >= table.hurst[place + 1]) place += 1;
  const share = (hurst - table.hurst[place]) / (table.hurst[place + 1] - table.hurst[place]);
  const linear = (low, high) => low + share * (high - low);
  const geometric = (low, high) => low * (high / low) ** share;
  const law = {};
  for (const [name, values] of Object.entries(table)) {
    const between = ["x_low", "x_high", "bend", "cutoff"].includes(name) ? geometric : linear;
    law[name] = between(values[place], values[place + 1]);
  }
  return law;
}

/** g(X), the interface's part of vt/h. */
function interfaceVelocity(law, x) {
  const power = law.amplitude * x ** law.exponent * (1 + x / law.bend) ** -law.fall;
  const falling = power * (1 + (x / law.cutoff) ** 2) ** -4;
  return falling / (1 + (falling / (law.one_element * x)) ** 1.5) ** (2 / 3);
}

/** The interface's part of u/h: g integrated over ln X by Simpson's rule, as in Python. */
function interfaceDepth(law, x) {
  let sum = 0;
  for (let i = 0; i <= 800; i += 1) {
    const weight = i % 800 === 0 ? 1 : i % 2 ? 4 : 2;
    sum += weight * interfaceVelocity(law, x * Math.exp(-0.05 * i));
  }
  return (0.05 / 3) * sum;
}

/** Depth and velocity with their intervals, in the units of rms height and time; where: "", "below" or "above". */
function estimate(law, { rms, diameter, force, viscosity, time }) {
  const x = (force * time) / viscosity / (4 * rms * diameter);
  const where = x < law.x_low ? "below" : x > law.x_high ? "above" : "";
  const depth = rms * (x + interfaceDepth(law, x));
  const velocity = (rms / time) * (x + interfaceVelocity(law, x));
  return {
    x,
    where,
    depth: [depth, depth * (1 - law.depth_error), depth * (1 + law.depth_error)],
    velocity: [velocity, velocity * (1 - law.velocity_error), velocity * (1 + law.velocity_error)],
  };
}

/** A number to three significant digits, as text. */
function readable(value) {
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return Number(value.toPrecision(3)).toString();
  const [mantissa, exponent] = value.toExponential(2).split("e");
  const raised = [...String(Number(exponent))].map((sign) => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign])).join("");
  return `${Number(mantissa)}×10${raised}`;
}

const UNITS = { rms: 1e-6, diameter: 1e-3, force: 1, viscosity: 1, time: 1, hurst: 1 };

/** Values of the form in SI units, or an error message. */
function entered(form, table) {
  const values = {};
  for (const [name, unit] of Object.entries(UNITS)) {
    const field = form.elements[name];
    const value = field.valueAsNumber;
    if (!(value > 0)) return `${field.labels[0].textContent.trim()}: a number above 0 is needed.`;
    values[name] = value * unit;
  }
  const [low, high] = [table.hurst[0], table.hurst[table.hurst.length - 1]];
  if (values.hurst < low || values.hurst > high) return `The law was calibrated for H from ${low} to ${high}.`;
  return values;
}

/** Tell the chart of Figure 2 where the estimate lies: {x, velocity} with vt/h as velocity, or null. */
function announce(detail) {
  document.dispatchEvent(new CustomEvent("estimate", { detail }));
}

/** Write the estimate for the values of the form into the page, and mark it in the chart if the reader entered them. */
function update(form, table, output, marked) {
  const values = entered(form, table);
  announce(null);
  if (typeof values === "string") {
    output.textContent = values;
    return;
  }
  const law = penetrationLaw(table, values.hurst);
  const result = estimate(law, values);
  const per = (4 * values.rms * values.diameter * values.viscosity) / values.force;
  const range = `Valid from ${readable(law.x_low * per)} s to ${readable(law.x_high * per)} s`;
  if (result.where) {
    output.textContent = `X = ${readable(result.x)} is ${result.where} its range: no estimate. ${range}.`;
    return;
  }
  if (marked) announce({ x: result.x, velocity: (result.velocity[0] * values.time) / values.rms });
  const text = ([value, low, high]) => `${readable(1e6 * value)} [${readable(1e6 * low)}, ${readable(1e6 * high)}]`;
  output.textContent =
    `Depth ${text(result.depth)} µm, velocity ${text(result.velocity)} µm/s, at X = ${readable(result.x)}. ${range}.`;
}

if (typeof document !== "undefined") {
  const form = document.getElementById("calculator");
  const table = JSON.parse(document.getElementById("law").textContent);
  const output = document.getElementById("estimate-output");
  form.addEventListener("input", () => update(form, table, output, true));
  form.addEventListener("submit", (event) => event.preventDefault());
  update(form, table, output, false);
}
