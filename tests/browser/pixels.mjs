// SPDX-License-Identifier: BSD-3-Clause
// What a tab shows.

// The pixels of a PNG, decoded by the browser: a number of 32 bits each, red in the lowest 8.
// They come as Base64, because a list of a million numbers takes the browser seconds to send.
export async function pixelsOf(tab, base64) {
  const url = await tab.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const context = new OffscreenCanvas(image.width, image.height).getContext("2d");
    context.drawImage(image, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, image.width, image.height);
    const reader = new FileReader();
    reader.readAsDataURL(new Blob([pixels]));
    await new Promise((done) => { reader.onload = done; });
    return reader.result;
  }, base64);
  const bytes = Buffer.from(url.slice(url.indexOf(",") + 1), "base64");
  return new Uint32Array(new Uint8Array(bytes).buffer);
}
