flbc transfer out/limb/domain_weights.npy --cage meshes/3d/limb_cage.obj \
  --domain out/limb/domain.mesh --to meshes/3d/limb_model.obj -o out/transferred.npy
