// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which files a domain mesh can go to.
#pragma once

#include <string>

#include "files/load.h"
#include "flbc/io/mesh_io.h"

namespace flbc::app {

inline std::string domain_formats_help() {
  return "mesh file: .obj .off .vtu (2D), .mesh .node .ele .msh .vtu (3D)";
}

template <int Dim>
void require_domain_writable(const std::string& path) {
  if constexpr (Dim == 2) {
    require_writable(path, {"obj", "off", "vtu"});
  } else {
    require_writable(path, {"mesh", "node", "ele", "msh", "vtu"});
  }
}

}  // namespace flbc::app
