// SPDX-License-Identifier: BSD-3-Clause
// Loads the program of the page once the start screen has been painted.
import { unpacked } from "../js/unpacked.mjs";

// The browser would open files that are dropped before the program is there; app.mjs takes them.
for (const name of ["dragover", "drop"]) {
  addEventListener(name, (event) => {
    event.preventDefault();
    if (name === "drop") globalThis.flbcDropped = event.dataTransfer.files;
  });
}

const loaded = new Promise((done) => { new PerformanceObserver(done).observe({ type: "paint", buffered: true }); }).then(async () => {
  const { program, ...assets } = JSON.parse(document.getElementById("assets").textContent);
  globalThis.flbcAssets = assets;
  const parts = await Promise.all([assets.page.viewer, program].map(unpacked));
  const text = parts.map((bytes) => new TextDecoder().decode(bytes)).join("");
  document.getElementById("assets").replaceWith(Object.assign(document.createElement("script"), { type: "module", text }));
});
loaded.catch(({ message }) => {
  Object.assign(document.getElementById("problem"), { textContent: `This browser cannot unpack this page: ${message}`, hidden: false });
});
