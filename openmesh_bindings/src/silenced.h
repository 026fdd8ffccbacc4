// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! OpenMesh without its messages.
#pragma once

#include <OpenMesh/Core/System/omstream.hh>

namespace flbc::openmesh {

//! OpenMesh explains its refusals, and tells how many bytes it wrote, on streams of its own that
//! lead to standard error; the library must not print. They are silent while this lives.
class SilencedOpenMesh {
 public:
  SilencedOpenMesh() {
    omerr().disable();
    omlog().disable();
  }
  ~SilencedOpenMesh() {
    omerr().enable();
    omlog().enable();
  }
  SilencedOpenMesh(const SilencedOpenMesh&) = delete;
  SilencedOpenMesh& operator=(const SilencedOpenMesh&) = delete;
};

}  // namespace flbc::openmesh
