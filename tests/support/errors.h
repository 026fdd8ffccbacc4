// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Expected exceptions, their messages, and other texts.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>

#include <gtest/gtest.h>

#include "flbc/errors.h"

namespace flbc::testing {

//! That a text has a piece.
inline void expect_piece(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << "no '" << piece << "' in: " << text;
}

//! That a text does not have a piece.
inline void expect_no_piece(const std::string& text, const std::string& piece) {
  EXPECT_EQ(text.find(piece), std::string::npos) << "'" << piece << "' in: " << text;
}

//! That `action` throws an Exception whose message has all the pieces.
template <class Exception>
void expect_error(const std::function<void()>& action, std::initializer_list<std::string> pieces) {
  try {
    action();
  } catch (const Exception& error) {
    for (const std::string& piece : pieces) expect_piece(error.what(), piece);
    return;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "another kind of exception: " << error.what();
    return;
  }
  ADD_FAILURE() << "no exception; expected one about " << *pieces.begin();
}

template <class Exception = InputError>
void expect_refused(const std::string& words, const std::function<void()>& action) {
  expect_error<Exception>(action, {words});
}

}  // namespace flbc::testing
