flbc plot out/solve.json -o out/solve.svg
