flbc export meshes/3d/limb_model.obj --weights out/limb/binding.npz \
  --pose meshes/3d/limb_cage.obj meshes/3d/limb_cage_pose.obj --fps 1 -o out/limb.glb
