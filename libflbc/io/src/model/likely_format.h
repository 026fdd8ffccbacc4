// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! What the content of a file looks like, whatever its extension says.
#pragma once

#include <string>

namespace flbc::io {

//! The extension of the model format that a content looks like, or of another format that users
//! have (glb, fbx, png, vtu); "binary" for other bytes that are no text; empty if unknown.
std::string likely_format(const std::string& content);

}  // namespace flbc::io
