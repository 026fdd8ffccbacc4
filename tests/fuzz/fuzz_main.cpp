// SPDX-License-Identifier: BSD-3-Clause
// flbc_fuzz READER [libFuzzer's options]; flbc_fuzz --list; flbc_fuzz --seeds FOLDER
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <set>
#include <utility>

#include "fuzz/reader.h"

namespace {

using flbc::fuzz::Reading;

std::unique_ptr<Reading> reading;

void list() {
  for (const auto& reader : flbc::fuzz::all_readers()) {
    std::puts(reader.name.c_str());
  }
}

// The words of the seeds, as a dictionary of libFuzzer.
std::set<std::string> words_of(const std::vector<std::string>& seeds) {
  std::set<std::string> words{"nan", "-1", "1e999", "1e-320", "4294967296"};
  for (const auto& seed : seeds) {
    std::string word;
    for (const char c : seed + '\n') {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
        word += c;
      } else if (!word.empty()) {
        words.insert(std::exchange(word, {}));
      }
    }
  }
  return words;
}

void write_seeds(const std::string& folder) {
  for (const auto& reader : flbc::fuzz::all_readers()) {
    std::filesystem::create_directories(folder + "/" + reader.name);
    for (std::size_t k = 0; k < reader.seeds.size(); ++k) {
      const auto& seed = reader.seeds[k];
      const auto path = folder + "/" + reader.name + "/seed" + std::to_string(k);
      flbc::fuzz::put_file(path, seed.data(), seed.size());
    }
    std::ofstream dictionary(folder + "/" + reader.name + ".dict");
    for (const auto& word : words_of(reader.seeds)) dictionary << '"' << word << "\"\n";
  }
}

std::unique_ptr<Reading> open_reader(const std::string& name) {
  for (const auto& reader : flbc::fuzz::all_readers()) {
    if (reader.name == name) return std::make_unique<Reading>(reader);
  }
  std::fprintf(stderr, "no reader \"%s\"; flbc_fuzz --list names all\n", name.c_str());
  std::exit(1);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  char** const words = *arguments;
  if (*count < 2) {
    std::fputs("usage: flbc_fuzz READER [options] | --list | --seeds FOLDER\n", stderr);
    std::exit(1);
  }
  if (std::strcmp(words[1], "--list") == 0) {
    list();
    std::exit(0);
  }
  if (std::strcmp(words[1], "--seeds") == 0 && *count > 2) {
    write_seeds(words[2]);
    std::exit(0);
  }
  reading = open_reader(words[1]);
  for (int k = 1; k + 1 < *count; ++k) words[k] = words[k + 1];
  --*count;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* bytes, std::size_t size) {
  reading->accepts({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
