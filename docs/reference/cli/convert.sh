flbc convert out/weights.npy -o out/weights.mtx
