flbc deform meshes/3d/limb_model.obj --weights out/limb/binding.npz \
  --pose meshes/3d/limb_cage_pose.obj -o out/posed.obj
flbc deform meshes/3d/limb_model.obj --method green \
  --rest meshes/3d/limb_cage.obj --pose meshes/3d/limb_cage_pose.obj -o out/green.obj
