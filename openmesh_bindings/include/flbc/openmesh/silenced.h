// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Suppresses messages of OpenMesh.
#pragma once

#include <OpenMesh/Core/System/omstream.hh>

namespace flbc::openmesh {

//! Disables the message streams of OpenMesh during its lifetime. OpenMesh prints errors and byte
//! counts to standard error, and the library must not print.
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
  bool errors_, log_;  // whether they were enabled before
};

}  // namespace flbc::openmesh
