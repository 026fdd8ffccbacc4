// SPDX-License-Identifier: BSD-3-Clause
// Colorings of the model: a number from 0 to 1 at every point, and a legend of it.

export const kColorings = {
  shaded: "Plain",
  materials: "Materials",
  displacement: "Displacement",
  weight: "Weight",
  influences: "Influences",
};

// Three digits, without needless zeros.
export function shortNumber(value) {
  return String(Number(value.toPrecision(3)));
}

// Some of the vertices, for people: in percent, or counted where these are few.
export function portion(count, total) {
  const percent = 100 * count / total;
  if (percent >= 0.1 || count === 0) return `${shortNumber(percent)}% of the vertices`;
  return `${count} ${count === 1 ? "vertex" : "vertices"}`;
}

// \return values (null: none are shown) and the legend: title, least and greatest
export function colorValues(coloring, deformer, selection) {
  if (coloring === "displacement") {
    const values = deformer.displacements();
    const largest = values.reduce((most, value) => Math.max(most, value), 0);
    if (largest > 0) for (let p = 0; p < values.length; ++p) values[p] /= largest;
    return { values, legend: { title: "Displacement", low: "0", high: shortNumber(largest) } };
  }
  if (coloring === "weight") {
    const points = [...selection].sort((a, b) => a - b);
    const title = points.length === 0 ? "Weight: select a control point"
                : points.length === 1 ? `Weight of control point ${points[0]}`
                : `Weights of ${points.length} control points`;
    return { values: deformer.weightsOf(selection), legend: { title, low: "0", high: "1" } };
  }
  if (coloring === "influences") {
    const values = deformer.influenceCounts();
    const most = values.reduce((greatest, value) => Math.max(greatest, value), 1);
    for (let p = 0; p < values.length; ++p) values[p] /= most;
    return { values, legend: { title: "Influences per vertex", low: "0", high: String(most) } };
  }
  return { values: null, legend: null };
}
