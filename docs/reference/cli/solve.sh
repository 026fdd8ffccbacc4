flbc solve meshes/3d/limb_cage.obj --model meshes/3d/limb_model.obj --vertices 3000 \
  --report out/solve.json -o out/weights.npy
