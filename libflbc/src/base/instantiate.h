// SPDX-License-Identifier: BSD-3-Clause
// Explicit instantiation for both dimensions and both scalar types.
#pragma once

//! Instantiates a function template for both dimensions; it must not be overloaded.
#define FLBC_INSTANTIATE_FUNCTION(name) \
  template decltype(name<2>) name<2>;   \
  template decltype(name<3>) name<3>;

//! The same for templates of scalar type and dimension.
#define FLBC_INSTANTIATE_SCALAR_FUNCTION(name)        \
  template decltype(name<float, 2>) name<float, 2>;   \
  template decltype(name<float, 3>) name<float, 3>;   \
  template decltype(name<double, 2>) name<double, 2>; \
  template decltype(name<double, 3>) name<double, 3>;
#define FLBC_INSTANTIATE_SCALAR_CLASS(name) \
  template class name<float, 2>;            \
  template class name<float, 3>;            \
  template class name<double, 2>;           \
  template class name<double, 3>;
