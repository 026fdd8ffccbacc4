// SPDX-License-Identifier: BSD-3-Clause
// Weights from one format to another.
#pragma once

#include <string>

namespace flbc::app {

//! A conversion of weights, with the cage and points that belong to them if given.
struct WeightConversion {
  std::string input;
  std::string output;
  std::string cage;        //!< of the weights; empty = not known
  std::string points;      //!< model or mesh they belong to; empty = not known
  bool transpose = false;  //!< the input has control points as rows
};

//! By the extension.
bool is_weight_file(const std::string& path);

//! Reads weights and writes them in another format, and prints their size unless `quiet`. \throws
//! IoError; InputError, also if the weights do not fit cage or points
void convert_weights(const WeightConversion& conversion, bool quiet);

}  // namespace flbc::app
