// SPDX-License-Identifier: BSD-3-Clause
// The table of all formats with their readers and writers.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "flbc/io/formats.h"
#include "flbc/io/mesh_io.h"
#include "flbc/sparse_weights.h"
#include "model/model_scan.h"

namespace flbc::io {

//! The elements to which a format attaches colors, normals, and texture coordinates.
enum class Attributes { kNone, kVertices, kCorners };

struct ModelFormat {
  void (*read)(const std::string& path, Extent extent, ModelScan& scan) = nullptr;
  void (*write)(std::ostream& out, const Model& model) = nullptr;
  Attributes attributes = Attributes::kNone;
};

template <int Dim>
struct MeshFormat {
  DomainMesh<Dim> (*read)(const std::string& path) = nullptr;
  void (*write)(const std::string& path, const DomainMesh<Dim>& mesh,
                const std::vector<VertexField>& fields) = nullptr;
  bool keeps_fields = false;
};

struct WeightFormat {
  SparseWeights (*read)(const std::string& path, std::string content) = nullptr;
  void (*write)(std::ostream& out, const SparseWeights& weights) = nullptr;
};

//! A null pointer means that the format lacks this content.
struct Format {
  std::string_view extension;
  ModelFormat model{};
  MeshFormat<2> mesh_2d{};
  MeshFormat<3> mesh_3d{};
  WeightFormat weights{};

  template <int Dim>
  const auto& mesh() const {
    if constexpr (Dim == 2) {
      return mesh_2d;
    } else {
      return mesh_3d;
    }
  }
};

//! The format of a file.
//! \param action  description of the action, for messages
//! \throws OptionError listing suitable formats if it does not hold such content
const Format& format_of(const std::string& path, Content content, const char* action);

}  // namespace flbc::io
