flbc mesh meshes/3d/limb_cage.obj --vertices 3000 -o out/domain.vtu
