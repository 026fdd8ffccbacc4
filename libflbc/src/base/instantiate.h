// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Explicit instantiation for both dimensions.
#pragma once

//! Instantiates a function template of the dimension; it must not be overloaded.
#define FLBC_INSTANTIATE_FUNCTION(name) \
  template decltype(name<2>) name<2>;   \
  template decltype(name<3>) name<3>;
