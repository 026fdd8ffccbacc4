// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! flbc view --serve.
#pragma once

#include <string>

#include "files/upright.h"
#include "flbc/types.h"

namespace flbc::app {

struct ServeArguments {
  std::string cage;
  std::string model;   //!< empty: the mesh of the interior is shown
  Index vertices = 0;  //!< of the mesh, 0 = as make_domain() chooses
  int port = 0;        //!< 0 = any that is free
  UpAxis up = UpAxis::kAuto;
  bool quiet = false;
};

//! Serves the page until its last window is closed or the user interrupts. Prints its address on
//! standard output. \throws IoError, InputError, OptionError
void serve_page(const ServeArguments& arguments);

}  // namespace flbc::app
