// SPDX-License-Identifier: BSD-3-Clause
#pragma once

//! Instantiates a function template for both dimensions; it must not be overloaded.
#define FLBC_INSTANTIATE_FUNCTION(name) \
  template decltype(name<2>) name<2>;   \
  template decltype(name<3>) name<3>;
