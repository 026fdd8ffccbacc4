// SPDX-License-Identifier: BSD-3-Clause
// The package as others use it: packages_test.mjs WORK MODULES [BROWSER]
// WORK: a folder in which it is installed. MODULES: folder of bundlers, TypeScript, and three.js.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { join } from "node:path";

const [work, modules, browserPath] = process.argv.slice(2);
const put = (name, text) => writeFileSync(join(work, name), text);
const run = (...words) => execFileSync(process.execPath, words, { cwd: work, encoding: "utf8" }).split("\n").at(-2);
const installed = join(work, "node_modules");

// The first example of the package in Node.js.
const example = /```js\n([^]*?)```/.exec(readFileSync(join(installed, "flbc/README.md"), "utf8"))[1];
put("example.mjs", `${example}\nconsole.log(moved.length);\n`);
const expected = run("example.mjs");
assert.equal(expected, "12");

if (existsSync(join(modules, "esbuild"))) {
  for (const name of ["three", "@types"]) {
    if (!existsSync(join(installed, name))) symlinkSync(join(modules, name), join(installed, name));
  }
  const require = createRequire(join(modules, "x.js"));

  // What bundlers make of it runs without the package. A module for Node.js only would be an error.
  const { build } = require("esbuild");
  const made = await build({ entryPoints: [join(work, "example.mjs")], bundle: true, format: "esm", platform: "browser",
                             target: "es2022", outfile: join(work, "esbuild.mjs"), logLevel: "silent" });
  assert.deepEqual(made.warnings, []);
  assert.equal(run("esbuild.mjs"), expected);
  const stats = await new Promise((done, fail) => {
    require("webpack")({ mode: "production", context: work, entry: "./example.mjs", target: "web",
                         experiments: { outputModule: true }, performance: { hints: false },
                         output: { path: work, filename: "webpack.mjs", module: true } },
                       (error, result) => (error ? fail(error) : done(result)));
  });
  assert.deepEqual(stats.toJson().errors.concat(stats.toJson().warnings).map(({ message }) => message), []);
  assert.equal(run("webpack.mjs"), expected);
  mkdirSync(join(work, "vite"), { recursive: true });
  const vite = await import(join(modules, "vite/dist/node/index.js"));
  await vite.build({ root: work, logLevel: "silent", configFile: false,
                     build: { target: "es2022", outDir: "vite", lib: { entry: "example.mjs", formats: ["es"], fileName: () => "out.mjs" } } });
  assert.equal(run("vite/out.mjs"), expected);

  // The examples are right in strict TypeScript.
  const page = readFileSync(join(installed, "flbc/examples/three.html"), "utf8");
  put("example.ts", `${example}\nexport const blob = new Blob([await flbc.glb()]);\n`);
  put("three.ts", /<script type="module">\n([^]*?)<\/script>/.exec(page)[1]
    .replace("frame(time)", "frame(time: number)").replace("geometry.index.", "geometry.index!."));
  put("tsconfig.json", JSON.stringify({
    compilerOptions: { strict: true, noEmit: true, module: "esnext", moduleResolution: "bundler", target: "es2022",
                       lib: ["es2022", "dom", "dom.iterable"], types: [], skipLibCheck: true },
    files: ["example.ts", "three.ts"] }));
  try {
    run(join(modules, "typescript/bin/tsc"), "-p", "tsconfig.json");
  } catch (error) {
    assert.fail(error.stdout);
  }

  // The example of three.js moves in a browser.
  if (browserPath) {
    const { launch } = await import("../browser/page.mjs");
    const types = { mjs: "text/javascript", js: "text/javascript", html: "text/html" };
    const server = createServer((request, response) => {
      const path = join(work, decodeURI(request.url));
      if (!existsSync(path)) return response.writeHead(404).end();
      response.writeHead(200, { "Content-Type": types[/[^.]*$/.exec(path)[0]] ?? "application/octet-stream" })
        .end(readFileSync(path));
    });
    await new Promise((done) => { server.listen(0, "127.0.0.1", done); });
    const browser = await launch(browserPath);
    try {
      put("three.html", page);
      const tab = await browser.newPage();
      const failures = [];
      tab.on("pageerror", (error) => failures.push(error.message));
      await tab.goto(`http://127.0.0.1:${server.address().port}/three.html`);
      await tab.waitForSelector("canvas", { timeout: 60000 });
      const shot = () => tab.screenshot({ encoding: "base64" });
      const first = await shot();
      for (let k = 0, now = first; now === first; ++k, now = await shot()) {
        assert.deepEqual(failures, []);
        assert.ok(k < 200, "nothing moves");
        await new Promise((done) => { setTimeout(done, 300); });
      }
      await tab.screenshot({ path: join(work, "three.png") });
    } finally {
      await browser.close();
      server.close();
    }
  }
  console.log("esbuild, webpack, Vite, and TypeScript take the package");
}
