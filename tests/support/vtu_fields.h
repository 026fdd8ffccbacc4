// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The fields of .vtu files, which the library only writes.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "flbc/io/mesh_io.h"

namespace flbc::testing {

//! The arrays between the tags of PointData. \param text  of a file whose arrays are text
inline std::vector<io::VertexField> fields_in_vtu(const std::string& text) {
  std::vector<io::VertexField> fields;
  const auto end = text.find("</PointData>");
  for (auto tag = text.find("<PointData>");
       (tag = text.find("Name=\"", tag)) < end && end != std::string::npos; ++tag) {
    const auto name = tag + 6, numbers = text.find('>', tag) + 1;
    std::istringstream words(text.substr(numbers, text.find('<', numbers) - numbers));
    std::vector<double> values;
    for (std::string word; words >> word;) values.push_back(std::stod(word));
    fields.push_back({text.substr(name, text.find('"', name) - name),
                      Eigen::Map<const Eigen::VectorXd>(values.data(),
                                                        static_cast<Eigen::Index>(values.size()))});
  }
  return fields;
}

}  // namespace flbc::testing
