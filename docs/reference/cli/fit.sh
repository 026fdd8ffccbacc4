flbc fit meshes/3d/limb_model.obj out/limb/deformed.obj --weights out/limb/binding.npz \
  -o out/fitted_pose.obj
