flbc sparsify out/limb/binding.npz -k 4 -o out/four.npz
flbc sparsify out/weights.npy --cage meshes/3d/limb_cage.obj \
  --points meshes/3d/limb_model.obj -k 4 -o out/weights_4.mtx
