// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Scripts by which shells complete commands, options and their values.
#pragma once

#include <string>

#include "help/command_table.h"

namespace flbc::app {

std::string bash_completion(const CommandTable& table);

std::string zsh_completion(const CommandTable& table);

}  // namespace flbc::app
