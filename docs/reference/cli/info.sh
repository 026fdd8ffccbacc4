flbc info out/weights.npy
