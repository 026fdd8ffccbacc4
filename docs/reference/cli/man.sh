flbc man solve >out/flbc-solve.1
