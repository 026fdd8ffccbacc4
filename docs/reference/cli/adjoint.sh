# gradients of half the sum of squared coordinates
grep '^v ' meshes/3d/limb_model.obj | cut -d ' ' -f 2- | tr ' ' ',' >out/gradients.csv
flbc adjoint out/gradients.csv --weights out/limb/binding.npz -o out/dJ_dc.csv
