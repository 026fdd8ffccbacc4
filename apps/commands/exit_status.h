// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Exit status of the program: stable, scripts depend on it.
#pragma once

namespace flbc::app {

enum ExitStatus : int {
  kDone = 0,
  kWrongUsage = 1,    //!< unknown or impossible options
  kBadInput = 2,      //!< a defect in a file's content
  kNotConverged = 3,  //!< results are written nevertheless, the report says so
  kIoFailure = 4,     //!< a file cannot be opened, read or written
  kOutOfMemory = 5
};

}  // namespace flbc::app
