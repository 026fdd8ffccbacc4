// SPDX-License-Identifier: BSD-3-Clause
#include "solve/sealed_file.h"

#include <cstring>
#include <ostream>
#include <streambuf>

#include "flbc/byte_archive.h"
#include "flbc/io/files.h"

namespace flbc::app {
namespace {

// Passes bytes on and keeps their hash.
class HashingBuffer : public std::streambuf {
 public:
  explicit HashingBuffer(std::ostream& out) : out_(out) {}

  std::uint64_t hash() const { return hash_.value(); }

 protected:
  std::streamsize xsputn(const char* data, std::streamsize size) override {
    hash_.add(data, static_cast<std::size_t>(size));
    return out_.write(data, size) ? size : 0;
  }
  int_type overflow(int_type letter) override {
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    const char byte = traits_type::to_char_type(letter);
    return xsputn(&byte, 1) == 1 ? letter : traits_type::eof();
  }

 private:
  std::ostream& out_;
  ContentHash hash_;
};

std::uint64_t number_at(std::string_view bytes) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

}  // namespace

SealedContent open_sealed(std::string_view content, std::string_view first_line,
                          const std::string& kind) {
  constexpr auto kNumber = sizeof(std::uint64_t);
  if (content.substr(0, first_line.size()) != first_line ||
      content.size() < first_line.size() + 2 * kNumber) {
    throw InputError("it is no file of " + kind + " of this format");
  }
  const auto checked = content.substr(0, content.size() - kNumber);
  if (hash_of(checked) != number_at(content.substr(checked.size()))) {
    throw InputError("it is damaged: its checksum is wrong");
  }
  const auto rest = checked.substr(first_line.size() + kNumber);
  const auto key_size = number_at(checked.substr(first_line.size()));
  if (key_size > rest.size()) throw InputError("it ends early");
  return {rest.substr(0, key_size), rest.substr(key_size)};
}

void write_sealed(const std::string& path, std::string_view first_line, const std::string& key,
                  const std::function<void(std::ostream&)>& payload) {
  io::write_file(path, [&](std::ostream& file) {
    HashingBuffer buffer(file);
    std::ostream out(&buffer);
    ByteWriter write(out);
    write.bytes(first_line.data(), first_line.size());
    write(static_cast<std::uint64_t>(key.size()));
    write.bytes(key.data(), key.size());
    payload(out);
    if (!out) file.setstate(std::ios::failbit);
    write(buffer.hash());
  });
}

}  // namespace flbc::app
