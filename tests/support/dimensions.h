// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Tests that run in 2D and in 3D.
#pragma once

#include <type_traits>

#include <gtest/gtest.h>

namespace flbc::testing {

//! For TYPED_TEST_SUITE().
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;

}  // namespace flbc::testing

//! TEST() for both dimensions; its body has the template parameter `Dim`.
#define TEST_IN_2D_AND_3D(suite, name) \
  template <int Dim>                   \
  void suite##name();                  \
  TEST(suite, name##In2D) {            \
    suite##name<2>();                  \
  }                                    \
  TEST(suite, name##In3D) {            \
    suite##name<3>();                  \
  }                                    \
  template <int Dim>                   \
  void suite##name()
