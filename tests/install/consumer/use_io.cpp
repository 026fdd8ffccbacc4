// SPDX-License-Identifier: BSD-3-Clause
// The library of file formats, part of the core package: weights come back as they were written.
#include <iostream>

#include <flbc/io/weights_io.h>

#include "judge.h"

int main() {
  const flbc::WeightMatrix weights = flbc::WeightMatrix::Random(4, 3);
  flbc::io::write_weights("consumer_weights.npy", weights);
  const bool same = flbc::io::read_weights("consumer_weights.npy") == weights;
  std::cout << "weights " << (same ? "come" : "do not come") << " back as they were written\n";
  return same ? 0 : 1;
}
