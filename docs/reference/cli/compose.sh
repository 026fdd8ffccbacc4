flbc solve meshes/3d/limb_cage.obj --model meshes/3d/limb_cage.obj -o out/map.npy
flbc compose out/limb/weights.npy out/map.npy -o out/composed.npy
