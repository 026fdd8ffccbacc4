flbc compare meshes/2d/figure_cage.obj meshes/2d/figure_model.obj --pose meshes/2d/figure_cage_pose.obj -o out/compared
