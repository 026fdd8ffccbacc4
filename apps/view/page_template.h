// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The page without its content, joined from the files in page/ when the program is built.
#pragma once

namespace flbc::view {

//! HTML with {{data}} where the content goes.
extern const char* const kPageTemplate;

}  // namespace flbc::view
