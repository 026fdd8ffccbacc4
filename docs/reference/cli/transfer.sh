flbc transfer out/limb/binding.npz --to meshes/3d/limb_model.obj -o out/transferred.npz
