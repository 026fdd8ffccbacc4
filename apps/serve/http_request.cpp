// SPDX-License-Identifier: BSD-3-Clause
#include "serve/http_request.h"

#include <algorithm>
#include <cctype>

namespace flbc::app {
namespace {

constexpr std::string_view kLineEnd = "\r\n";

std::string_view next_line(std::string_view& text) {
  const auto end = text.find(kLineEnd);
  const auto line = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + kLineEnd.size()));
  return line;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

}  // namespace

std::string HttpRequest::header(const std::string& name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

std::optional<std::size_t> head_size(std::string_view received) {
  constexpr std::string_view kEnd = "\r\n\r\n";
  const auto end = received.find(kEnd);
  if (end == std::string_view::npos) return {};
  return end + kEnd.size();
}

std::optional<HttpRequest> parse_head(std::string_view head) {
  const auto line = next_line(head);
  const auto first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return {};
  if (line.substr(last + 1, 7) != "HTTP/1.") return {};
  HttpRequest request{std::string(line.substr(0, first)),
                      std::string(line.substr(first + 1, last - first - 1)),
                      {}};
  while (!head.empty()) {
    const auto field = next_line(head);
    if (field.empty()) break;
    const auto colon = field.find(':');
    if (colon == std::string_view::npos) return {};
    const bool is_new =
        request.headers
            .emplace(lower(field.substr(0, colon)), std::string(trimmed(field.substr(colon + 1))))
            .second;
    if (!is_new) return {};
  }
  return request;
}

}  // namespace flbc::app
