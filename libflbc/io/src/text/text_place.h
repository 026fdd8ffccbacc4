// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Numbers and where they stand in a text.
#pragma once

#include <array>
#include <string>

#include "model/model_scan.h"
#include "text/text_reader.h"

namespace flbc::io {

//! Three numbers in a row.
struct PlacedNumbers {
  std::array<NumberPlace, 3> places;
  Vector<3> values = Vector<3>::Zero();
};

//! Reads the next three numbers on this line. One that is missing is 0, and its place is right
//! after the one before.
//! \param text  that `reader` reads
inline PlacedNumbers next_numbers(TextReader& reader, const std::string& text) {
  PlacedNumbers result;
  auto& places = result.places;
  for (std::size_t k = 0; k < 3; ++k) {
    // Words of their own: a line may be continued in the middle.
    if (reader.has_word()) {
      places[k] = {text.size() - reader.bytes_left(),
                   static_cast<std::uint32_t>(reader.peek().size()), NumberForm::kText};
      result.values[static_cast<Eigen::Index>(k)] = reader.number();
    } else if (k > 0) {
      places[k] = {places[k - 1].begin + places[k - 1].size, 0, NumberForm::kText};
    }
  }
  return result;
}

}  // namespace flbc::io
