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
  SilencedOpenMesh() : errors_(omerr().is_enabled()), log_(omlog().is_enabled()) {
    omerr().disable();
    omlog().disable();
  }
  ~SilencedOpenMesh() {
    if (errors_) omerr().enable();
    if (log_) omlog().enable();
  }
  SilencedOpenMesh(const SilencedOpenMesh&) = delete;
  SilencedOpenMesh& operator=(const SilencedOpenMesh&) = delete;

 private:
  bool errors_, log_;  // whether they spoke before
};

}  // namespace flbc::openmesh
