# Makes pages of samples in the current folder; to be sourced where $flbc and $meshes are set.

# Few influences; weights of any kind would do.
sample() { # DIM NAME
  local cage=$meshes/$1/$2_cage.obj model=$meshes/$1/$2_model.obj
  "$flbc" solve "$cage" --method harmonic --vertices 1500 -q -o "$2.npy" --model "$model"
  "$flbc" sparsify "$2.npy" --cage "$cage" --points "$model" -k 8 -q -o "$2.mtx"
  "$flbc" view "$model" --weights "$2.mtx" --cage "$cage" --pose "$meshes/$1/$2_cage_pose.obj" \
    -q -o "$2.html"
}
