// SPDX-License-Identifier: BSD-3-Clause
#include "front/wording.h"

namespace flbc::app {
namespace {

struct Wording {
  const char *library, *program;
};

constexpr Wording kWordings[] = {
    {"choose OutsidePoints kNearest, kKeep, or kExtend, or make a cage around the model with "
     "cage_from_model()",
     "add --outside nearest, by which they follow the cage, or --outside keep, by which they stay "
     "where they are; or make a cage around the model with flbc cage"},
    {"gap does not apply to weights that may be negative; choose non_negative constraint or "
     "project",
     "--gap does not apply to weights that may be negative; choose --non-negative constraint or "
     "project"},
    {"are not negative, so non_negative does not", "are not negative, so --non-negative does not"},
    {"which compute_coordinates() does not return; use green_coordinates() in C++",
     "so they have no file of weights; use flbc deform --method green, or flbc compare"},
    {"non_negative constraint is for the methods", "--non-negative constraint is for the methods"},
    {"gap must be positive", "--gap must be positive"},
    {"smoothness must be positive", "--smoothness must be positive"},
    {"smoothness is for the methods", "--smoothness is for the methods"},
    {"tolerance must be positive", "--tolerance must be positive"},
    {"penalty must be positive", "--penalty must be positive"},
    {"max_iterations must be at least", "--max-iterations must be at least"},
    {"threads must be in [1", "--threads must be in [1"},
    {"; make a symmetric cage, or leave out the mirror",
     "; make a symmetric cage with flbc cage --symmetric, or leave out --symmetric"},
    {"leave out the mirror", "leave out --symmetric"},
    {"max_influences must be at least", "-k must be at least"},
    {" s (time_limit)", " s (--mesh-timeout)"},
    {" (vertices), the minimum that", " (--vertices), the minimum that"},
    {"of its mesh; choose another mesher",
     "of its mesh; choose another --mesher, or leave out --embed"},
};

// "vertices: 3 vertices are too few", where a file name does not end.
void name_vertices(std::string& message) {
  constexpr const char* kName = "vertices: ";
  for (const char* end :
       {" are too many; at most", " vertices are too few:", " is not a number of vertices"}) {
    const auto at = message.find(end);
    const auto begin = at == std::string::npos ? at : message.rfind(kName, at);
    if (begin != std::string::npos) message.insert(begin, "--");
  }
}

}  // namespace

std::string in_words_of_program(std::string message) {
  for (const auto& [library, program] : kWordings) {
    const std::string words = program;
    for (auto at = message.find(library); at != std::string::npos;
         at = message.find(library, at + words.size())) {
      message.replace(at, std::string(library).size(), words);
    }
  }
  name_vertices(message);
  return message;
}

}  // namespace flbc::app
