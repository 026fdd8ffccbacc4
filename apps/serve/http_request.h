// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The head of an HTTP request.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace flbc::app {

//! Method, target, and headers of a request. Names of headers are in lowercase.
struct HttpRequest {
  std::string method;
  std::string target;
  std::map<std::string, std::string> headers;

  //! The value of a header; empty if it is absent.
  std::string header(const std::string& name) const;
};

//! The size of a head with its empty line, or nothing while it is incomplete.
std::optional<std::size_t> head_size(std::string_view received);

//! Parses a complete head. \return nothing if it is not HTTP/1 or repeats a header
std::optional<HttpRequest> parse_head(std::string_view head);

}  // namespace flbc::app
