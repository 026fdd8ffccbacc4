flbc draw meshes/3d/limb_model.obj --weights out/weights.npy \
  --cage meshes/3d/limb_cage.obj --pose meshes/3d/limb_cage_pose.obj -o out/posed.png
