// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Tests that run in 2D and in 3D.
#pragma once

#include <gtest/gtest.h>

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
