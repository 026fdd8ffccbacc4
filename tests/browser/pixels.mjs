// SPDX-License-Identifier: BSD-3-Clause
// What a tab shows.

// The pixels of a PNG, decoded by the browser: a number of 32 bits each, red in the lowest 8.
export function pixelsOf(tab, base64) {
  return tab.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, image.width, image.height);
    return Array.from(new Uint32Array(pixels.buffer));
  }, base64);
}
