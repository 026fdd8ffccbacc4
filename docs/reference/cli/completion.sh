flbc completion bash >out/flbc.bash
