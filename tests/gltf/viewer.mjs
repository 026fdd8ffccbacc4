// SPDX-License-Identifier: BSD-3-Clause
// What three.js, a viewer, makes of a skin: its own loader, animation and skinning. It knows four
// influences per vertex.
import { readFileSync } from 'node:fs';
import { AnimationMixer, LoopOnce, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

export class ViewedSkin {
  static async read(path) {
    const file = readFileSync(path);
    const bytes = file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength);
    const loaded = await new GLTFLoader().parseAsync(bytes, '');
    const skin = new ViewedSkin();
    skin.scene = loaded.scene;
    skin.scene.traverse((object) => {
      if (object.isSkinnedMesh) skin.mesh = object;
    });
    skin.mixer = new AnimationMixer(skin.scene);
    for (const clip of loaded.animations) {
      const action = skin.mixer.clipAction(clip);
      action.setLoop(LoopOnce);
      action.clampWhenFinished = true;
      action.play();
    }
    return skin;
  }

  // Which vertex of the model each one is.
  sources() {
    const { position, _vertex: numbers } = this.mesh.geometry.attributes;
    return Array.from({ length: position.count }, (_, v) => (numbers ? numbers.getX(v) : v));
  }

  // At rest if no time is given.
  positions(time) {
    if (time !== undefined) this.mixer.setTime(time);
    this.scene.updateMatrixWorld(true);
    const count = this.mesh.geometry.attributes.position.count;
    return Array.from({ length: count }, (_, v) => {
      const position = this.mesh.getVertexPosition(v, new Vector3());
      return position.applyMatrix4(this.mesh.matrixWorld).toArray();
    });
  }
}
