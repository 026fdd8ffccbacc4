// SPDX-License-Identifier: BSD-3-Clause
// Messages of the library in the words of the program.
#pragma once

#include <string>

namespace flbc::app {

//! The message with options of the program in place of the names of the library. For the end of its
//! way, to the terminal or into a report: a second time would find options in place of names.
std::string in_words_of_program(std::string message);

}  // namespace flbc::app
