// SPDX-License-Identifier: BSD-3-Clause
// Whether .glb files are valid by the Khronos validator: node check.mjs FILE...
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

for (const path of process.argv.slice(2)) {
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(path)));
  // Texture coordinates for which the file has no picture are no defect.
  const messages = issues.messages.filter(
    ({ code, pointer }) => !(code === 'UNUSED_OBJECT' && /TEXCOORD_0/.test(pointer)));
  if (messages.length > 0) throw new Error(`${path}: ${JSON.stringify(messages, null, 1)}`);
  console.log(`${path}: valid`);
}
