// SPDX-License-Identifier: BSD-3-Clause
#include "poses/file_sequence.h"

#include <filesystem>

#include "flbc/errors.h"

namespace flbc::app {
namespace {

struct Place {
  std::size_t begin = std::string::npos;
  std::size_t end = std::string::npos;
  std::size_t width = 0;
};

// The first %d or %0Nd from `start` on. Other percent signs are part of the name.
Place find_place(const std::string& name, std::size_t start = 0) {
  constexpr std::size_t kMostDigits = 2;
  for (auto begin = name.find('%', start); begin != std::string::npos;
       begin = name.find('%', begin + 1)) {
    const auto end = name.find_first_not_of("0123456789", begin + 1);
    if (end == std::string::npos || name[end] != 'd') continue;
    const auto digits = name.substr(begin + 1, end - begin - 1);
    if (digits.size() > kMostDigits) continue;
    return {begin, end + 1, digits.empty() ? 0 : std::stoul(digits)};
  }
  return {};
}

}  // namespace

bool has_number(const std::string& pattern) {
  const auto place = find_place(pattern);
  if (place.begin == std::string::npos) return false;
  if (find_place(pattern, place.end).begin != std::string::npos) {
    throw OptionError(pattern + ": there must be one %d in the name, not several");
  }
  return true;
}

std::string with_number(const std::string& pattern, std::int64_t number) {
  if (!has_number(pattern)) return pattern;
  const auto place = find_place(pattern);
  auto digits = std::to_string(number);
  if (digits.size() < place.width) digits.insert(0, place.width - digits.size(), '0');
  return pattern.substr(0, place.begin) + digits + pattern.substr(place.end);
}

std::vector<NumberedFile> find_files(const std::string& pattern) {
  std::error_code error;
  const auto exists = [&](std::int64_t number) {
    return std::filesystem::exists(with_number(pattern, number), error);
  };
  std::vector<NumberedFile> files;
  for (std::int64_t number = exists(0) ? 0 : 1; exists(number); ++number) {
    files.push_back({with_number(pattern, number), number});
  }
  if (files.empty()) {
    throw IoError(pattern + ": there is neither " + with_number(pattern, 0) + " nor " +
                  with_number(pattern, 1));
  }
  return files;
}

}  // namespace flbc::app
