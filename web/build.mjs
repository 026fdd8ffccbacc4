// SPDX-License-Identifier: BSD-3-Clause
// Joins the page and the npm package from what CMake has built:
//   node build.mjs BUILD_FOLDER VERSION [ADDRESS_OF_SOURCES]
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const [built, version, address] = process.argv.slice(2);
const at = (path) => new URL(path, import.meta.url);
const read = (path) => readFileSync(at(path), "utf8");
const view = "../libflbc/front/page/";
const dist = at("dist/");
mkdirSync(dist, { recursive: true });

const kLicense = `libflbc ${version}. SPDX-License-Identifier: AGPL-3.0-or-later. Contains TetGen (AGPL-3.0-or-later), `
  + `CGAL (GPL-3), Eigen (MPL-2.0), pugixml, nlohmann/json (MIT), fast_float, Boost; libflbc itself is BSD-3.`;

// The Debian packages whose code is in the module.
function sources() {
  const packages = ["libtet1.5-dev", "libcgal-dev", "libeigen3-dev", "nlohmann-json3-dev", "libpugixml-dev",
                    "libfast-float-dev", "libboost-dev", "emscripten"];
  const format = "-f=${source:Package} ${Version}, ";
  const found = execFileSync("dpkg-query", ["-W", format, ...packages], { encoding: "utf8" });
  return `the Debian packages ${found.replace(/, $/, "")}`;
}

// The modules in one scope, without import and export, comments, and indentation.
function joined(paths) {
  return paths.map(read).join("").replace(/^import .*$/gm, "").replace(/^export /gm, "")
    .replace(/^\s*\/\/.*\n/gm, "").replace(/ +\/\/ [^"'`\n]*$/gm, "").replace(/^ +/gm, "");
}

// Zopfli makes 5% fewer bytes of gzip than zlib.
function packed(bytes) {
  const file = fileURLToPath(new URL("unpacked", dist));
  writeFileSync(file, bytes);
  const made = execFileSync("zopfli", ["--i15", "-c", file], { maxBuffer: 2 ** 28 });
  rmSync(file);
  return made.toString("base64");
}

function assetsOf(name) {
  return {
    worker: packed(`${readFileSync(`${built}/${name}.js`, "utf8")}\n${read("js/worker.js")}`),
    wasm: packed(readFileSync(`${built}/${name}.wasm`)),
  };
}

// The viewer, whose modules are in flbc.html once, and the page around it that page() saves.
const names = /set\(page_modules\s+([^)]*)\)/.exec(read("../libflbc/front/CMakeLists.txt"))[1].trim().split(/\s+/);
const pageParts = {
  shell: packed(read(`${view}page.html`).replace("{{style}}", () => read(`${view}page.css`))),
  viewer: packed(joined(names.map((name) => `${view}${name}.mjs`))),
};

function module(assets, license) {
  const text = `// ${license}\n${joined(["js/unpacked.mjs"])}${read("js/flbc.mjs").replace(/import [^\n]*\n/, "")}`;
  return text.replace("/*{{assets}}*/ {}", () => JSON.stringify({ ...assets, page: pageParts }));
}

function decoders() {
  const of = (path) => packed(readFileSync(at(`decoders/node_modules/${path}`)));
  return { draco: of("draco3dgltf/draco_decoder_gltf_nodejs.js"), dracoWasm: of("draco3dgltf/draco_decoder_gltf.wasm"),
           meshopt: of("meshoptimizer/meshopt_decoder.mjs") };
}

function page(assets) {
  const program = packed(joined(["js/unpacked.mjs", "js/flbc.mjs", "page/reshaping.mjs", "page/protecting.mjs", "page/shapes.mjs", "page/frames.mjs", "page/cage_edits.mjs", "page/decoding.mjs", "page/app.mjs"]));
  const kSamples = { Character: "3d/character", Limb: "3d/limb", Torus: "3d/torus", "Figure, in 2D": "2d/figure" };
  const samples = {};
  let buttons = "";
  for (const [label, path] of Object.entries(kSamples)) {
    const name = path.slice(3);
    samples[`${name}.obj`] = packed(readFileSync(at(`../meshes/${path}_model.obj`)));
    const picture = readFileSync(at(`../meshes/pictures/${name}.webp`)).toString("base64");
    buttons += `<button data-sample="${name}.obj"><img src="data:image/webp;base64,${picture}" alt="">${label}</button>`;
  }
  const source = address ? `<a href="${address}">source code</a>` : `source code: libflbc ${version} and ${sources()}`;
  const app = read("page/app.html").replace("{{version}}", version).replace("{{source}}", source)
    .replace("{{samples}}", buttons).replace("{{moving}}", read("../meshes/pictures/figure_moving.svg"));
  // Base64 has no "<". It comes last, and is read after the page has been drawn.
  const late = `<script type="application/json" id="assets">${JSON.stringify({ program, page: pageParts, ...assets, samples, decoders: decoders() })}</script>\n`;
  const parts = { style: read(`${view}page.css`) + read("page/app.css"), data: "null",
                  script: joined(["js/unpacked.mjs", "page/loading.mjs"]) };
  return read(`${view}page.html`)
    .replace("<!-- SPDX-License-Identifier: BSD-3-Clause -->", `<!-- ${kLicense} Draco (Apache-2.0) and meshoptimizer (MIT) decode compressed glTF. -->`)
    .replace('<script type="application/json"', () => `${app}<script type="application/json"`)
    .replace("</body>", () => `${late}</body>`)
    .replace(/\{\{(style|data|script)\}\}/g, (_, part) => parts[part]);
}

const all = assetsOf("flbc_web");
const { worker } = all;
copyFileSync(`${built}/flbc_web.wasm`, new URL("flbc.wasm", dist));
const kCoreLicense = `libflbc ${version}. SPDX-License-Identifier: BSD-3-Clause. Contains Eigen (MPL-2.0), pugixml, `
  + "nlohmann/json (MIT), fast_float.";
const files = { "core.mjs": module(assetsOf("flbc_core"), kCoreLicense), "core.d.ts": 'export * from "./flbc.js";\n',
                "flbc.html": page(all), "index.html": page({ worker }), "flbc.mjs": module(all, kLicense),
                "slim.mjs": module({ worker }, kLicense), "flbc.d.ts": read("js/flbc.d.ts"),
                "slim.d.ts": 'export * from "./flbc.js";\n' };
for (const [name, text] of Object.entries(files)) writeFileSync(new URL(name, dist), text);
