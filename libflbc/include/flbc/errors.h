// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The exceptions of the library. A solve that does not converge does not throw; it sets the status
//! in the report.
#pragma once

#include <stdexcept>
#include <string>

namespace flbc {

//! Base of all exceptions thrown by libflbc.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

//! A defect of the input: cage, mesh, model, or weights. The message names file, element, and
//! coordinates if known.
class InputError : public Error {
 public:
  using Error::Error;
};

//! An option outside its valid range. The message names the option.
class OptionError : public Error {
 public:
  using Error::Error;
};

//! The domain mesh needs more vertices than requested. The message names the minimum.
class TooFewVertices : public OptionError {
 public:
  using OptionError::OptionError;
};

//! A file that cannot be opened, read, or written. The message names the file and the system error.
class IoError : public Error {
 public:
  using Error::Error;
};

//! A numerical breakdown, for example a matrix that cannot be factored.
class SolverError : public Error {
 public:
  using Error::Error;
};

}  // namespace flbc
