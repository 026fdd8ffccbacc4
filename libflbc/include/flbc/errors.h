// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The exceptions of the library. A solve that does not converge sets a status in the report
//! instead.
#pragma once

#include <stdexcept>
#include <string>

namespace flbc {

//! Base of all exceptions thrown by libflbc.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

//! A defect of the data: cage, mesh, model or weights. The text names file, element and coordinates
//! as far as they are known.
class InputError : public Error {
 public:
  using Error::Error;
};

//! An option outside its valid range. The text names the option.
class OptionError : public Error {
 public:
  using Error::Error;
};

//! A mesh of the cage needs more vertices than requested. The text names the minimum.
class TooFewVertices : public OptionError {
 public:
  using OptionError::OptionError;
};

//! A file that cannot be opened, read or written. The text names the file and the system's reason.
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
