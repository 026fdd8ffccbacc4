flbc check meshes/3d/limb_cage.obj --model meshes/3d/limb_model.obj --weights out/weights.npy
