// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Manual pages.
#pragma once

#include <string>

#include "help/command_table.h"

namespace flbc::app {

//! flbc(1), for man.
std::string manual_of_program(const CommandTable& table);

//! flbc-COMMAND(1), for man.
std::string manual_of_command(const CommandEntry& command);

}  // namespace flbc::app
