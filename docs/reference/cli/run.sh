flbc run meshes/3d/limb_cage.obj meshes/3d/limb_model.obj \
  --pose meshes/3d/limb_cage_pose.obj --vertices 3000 -o out/limb
