flbc cage meshes/3d/limb_model.obj --control-points 60 -o out/cage.obj
