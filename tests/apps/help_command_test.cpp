// SPDX-License-Identifier: BSD-3-Clause
// What --help shows, and what it hides.
#include <regex>

#include "support/command_line.h"

namespace flbc::testing {
namespace {

using Words = std::set<std::string>;

// All of a text that match.
Words found_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  Words words;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) {
    words.insert((*at)[1]);
  }
  return words;
}

class HelpCommands : public CommandLineTest {
 protected:
  // By the program's own help.
  Words commands() const {
    const auto help = run("--help").output;
    auto words = found_in(help.substr(help.find("Commands:")), R"(\n  ([a-z]+) +[a-z])");
    EXPECT_GE(words.size(), 14U) << help;
    return words;
  }
  Words options_of(const std::string& command) const {
    const auto help = run(command + " --help-all").output;
    // Lines of options begin with their names: "  -o,--output FILE"
    auto words = found_in(help, R"(\n  (?:-[a-zA-Z],)?(--[a-z-]+))");
    EXPECT_GE(words.size(), 2U) << help;
    return words;
  }
};

TEST_F(HelpCommands, ParserNamesTheCommandAndVersionTheComponents) {
  for (const auto& command : commands()) {
    const auto refused = run(command + " --no-such-option");
    EXPECT_EQ(refused.status, 1) << command;
    EXPECT_EQ(refused.errors.find("flbc " + command + ": "), 0U) << refused.errors;
  }
  const auto version = run("--version").output;
  for (const char* component : {"\nwith", "CGAL (", "TetGen ("}) {
    expect_piece(version, component);
  }
}

}  // namespace
}  // namespace flbc::testing
