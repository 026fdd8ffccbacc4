// SPDX-License-Identifier: BSD-3-Clause
// Poses and models as OBJ text.

// The cage's own file with other coordinates in the lines of the vertices that moved, so that
// everything else, digits included, stays as it was. \return null if the text does not hold these
// vertices
function rewrite(text, given, places, dim) {
  let vertex = 0;
  const lines = text.split("\n").map((line) => {
    const match = /^(\s*v\s+)(.*)$/.exec(line.replace(/\r$/, ""));
    if (!match) return line;
    const i = vertex++;
    const fields = match[2].split(/\s+/);
    let moved = false;
    for (let k = 0; k < dim; ++k) {
      if (Number(fields[k]) !== given[dim * i + k]) vertex = NaN;
      if (places[dim * i + k] === given[dim * i + k]) continue;
      fields[k] = String(places[dim * i + k]);
      moved = true;
    }
    return moved ? match[1] + fields.join(" ") + (line.endsWith("\r") ? "\r" : "") : line;
  });
  return vertex === given.length / dim ? lines.join("\n") : null;
}

// The control points of a pose, `dim` numbers each. \throws Error if it has not so many
export function readPose(text, dim, count) {
  const places = text.split("\n").filter((line) => /^\s*v\s/.test(line))
    .map((line) => line.trim().split(/\s+/).slice(1, dim + 1).map(Number));
  if (places.length !== count) throw new Error(`has ${places.length} vertices, but the cage has ${count} control points; a pose belongs to the cage that it was made with`);
  if (!places.every((place) => place.length === dim && place.every(Number.isFinite))) throw new Error("a coordinate is no number");
  return Float64Array.from(places.flat());
}

function vertexLine(places, dim, i) {
  return ["v", ...places.slice(dim * i, dim * i + dim), ...(dim === 2 ? [0] : [])].join(" ");
}

// \param places  of the control points, dim numbers each, as the cage's file has them
export function poseText(cageText, given, places, dim, facets) {
  const own = cageText ? rewrite(cageText, given, places, dim) : null;
  if (own !== null) return own;
  const lines = [];
  for (let i = 0; i < places.length / dim; ++i) lines.push(vertexLine(places, dim, i));
  for (let f = 0; f < facets.length; f += dim) {
    lines.push([dim === 2 ? "l" : "f", ...Array.from(facets.slice(f, f + dim), (i) => i + 1)].join(" "));
  }
  return lines.join("\n") + "\n";
}

// The moved model: all its points in their order, in the digits of single precision, and its
// triangles.
export function modelText(singles, dim, surface) {
  const lines = [];
  const points = Array.from(singles, (value) => Number(value.toPrecision(9)));
  for (let p = 0; p < points.length / dim; ++p) lines.push(vertexLine(points, dim, p));
  const { triangles, sources, textureCoordinates } = surface;
  if (textureCoordinates) {
    for (let v = 0; v < textureCoordinates.length; v += 2) {
      lines.push(`vt ${textureCoordinates[v]} ${1 - textureCoordinates[v + 1]}`);
    }
  }
  const corner = (v) => {
    const point = (sources ? sources[v] : v) + 1;
    return textureCoordinates ? `${point}/${v + 1}` : `${point}`;
  };
  for (let t = 0; t < triangles.length; t += 3) {
    lines.push(`f ${corner(triangles[t])} ${corner(triangles[t + 1])} ${corner(triangles[t + 2])}`);
  }
  return lines.join("\n") + "\n";
}
