// SPDX-License-Identifier: BSD-3-Clause
// Manual pages and completion: they have all that --help has, man takes the pages without a
// warning, and a shell completes.
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

std::string page(const std::string& name) {
  return slurp(std::string(FLBC_HELP_PAGES) + "/" + name);
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
    const auto shorts = found_in(help, R"(\n  (-[a-zA-Z]),)");
    words.insert(shorts.begin(), shorts.end());
    EXPECT_GE(words.size(), 2U) << help;
    return words;
  }

  // The completions by bash of the last of these words.
  Words offered(const std::vector<std::string>& words) const {
    std::string line;
    for (const auto& word : words) line += " '" + word + "'";
    std::ofstream("completion.sh") << "source '" << FLBC_HELP_PAGES << "/flbc.bash'\n"
                                   << "COMP_WORDS=(" << line << ")\nCOMP_CWORD=" << words.size() - 1
                                   << "\n_flbc\nprintf '%s\\n' \"${COMPREPLY[@]}\" >"
                                   << "offered";
    EXPECT_EQ(status_of("bash -u completion.sh"), 0);
    std::istringstream lines(slurp("offered"));
    Words offers;
    for (std::string word; std::getline(lines, word);) {
      if (!word.empty()) offers.insert(word);
    }
    return offers;
  }
};

// The build makes them where there is Python.
class HelpPages : public HelpCommands {
 protected:
  void SetUp() override {
    HelpCommands::SetUp();
    if (!std::filesystem::exists(FLBC_HELP_PAGES)) GTEST_SKIP() << "the build had no Python";
  }
};

TEST_F(HelpPages, EveryOptionIsOnItsPage) {
  const auto program = page("flbc.1");
  for (const auto& command : commands()) {
    expect_piece(program, ".TP\n\\fB" + command + "\\fR\n");
    const auto manual = page("flbc-" + command + ".1"), markdown = page(command + ".md");
    for (auto option : options_of(command)) {
      EXPECT_NE(markdown.find('`' + option), std::string::npos) << command << ' ' << option;
      option = std::regex_replace(option, std::regex("-"), "\\-");
      expect_piece(manual, "\\fB" + option + "\\fR");
    }
  }
}

// Names that options had before still work, and --help does not show them.
TEST_F(HelpCommands, OldNamesOfPosesAreHiddenAliases) {
  const std::pair<std::string, std::string> uses[] = {
      {"run c.obj --keyframes k.txt -o out", "--deformed"},
      {"deform m.obj --weights w.npy --rest c.obj --keyframes k.txt -o o.obj", "--cage"},
      {"export m.obj --weights w.npy --cage c.obj --keyframes k.txt -o o.glb", "--cages"}};
  for (const auto& [use, old_name] : uses) {
    const auto options = options_of(use.substr(0, use.find(' ')));
    EXPECT_EQ(options.count("--pose"), 1U) << use;
    EXPECT_EQ(options.count(old_name), 0U) << use;
    for (const auto& pose : {" --pose x.obj", " --pose=x.obj"}) {
      const auto renamed = std::regex_replace(std::string(pose), std::regex("--pose"), old_name);
      const auto refused = expect(use + renamed, 1, "cannot be combined with");
      EXPECT_EQ(refused.errors, run(use + pose).errors);
    }
  }
  for (const auto& [command, old_name] :
       {std::pair<std::string, std::string>{"run", "--sparsify"}, {"sparsify", "--method"}}) {
    const auto options = options_of(command);
    EXPECT_EQ(options.count("--reduction"), 1U) << command;
    EXPECT_EQ(options.count(old_name), 0U) << command;
    expect(command + " x " + old_name + " best -o y", 1, "--reduction: invalid value 'best'");
  }
  const auto cage = tetrahedron();
  const auto model = file("model.obj", "v 0.25 0.25 0.25\n");
  const auto deform = "deform " + model + " --weights " +
                      linear_weights(PointList<3>::Constant(3, 1, 0.25)) + " -q -o ";
  expect(deform + "new.obj --pose " + cage);
  expect(deform + "old.obj --cage " + cage);
  expect(deform + "equal.obj --cage=" + cage);
  EXPECT_NE(slurp("new.obj"), "");
  EXPECT_EQ(slurp("old.obj"), slurp("new.obj"));
  EXPECT_EQ(slurp("equal.obj"), slurp("new.obj"));
}

TEST_F(HelpPages, AreWithoutWarnings) {
  if (!has_program("groff")) GTEST_SKIP() << "groff is not installed";
  auto names = commands();
  names.insert("");
  for (const auto& name : names) {
    const auto page =
        std::string(FLBC_HELP_PAGES) + "/flbc" + (name.empty() ? "" : "-" + name) + ".1";
    ASSERT_EQ(status_of("groff -man -ww -Tutf8 '" + page + "' >page.txt 2>warnings.txt"), 0);
    EXPECT_EQ(slurp("warnings.txt"), "") << page;
    EXPECT_NE(slurp("page.txt").find("wrong usage"), std::string::npos) << page;
    if (!has_program("mandoc")) continue;
    EXPECT_EQ(status_of("mandoc -Tlint -Werror '" + page + "'"), 0) << page;
  }
}

TEST_F(HelpPages, BashCompletesCommandsOptionsAndValues) {
  EXPECT_EQ(offered({"flbc", "so"}), Words{"solve"});
  const auto all = offered({"flbc", ""});
  for (const auto& command : commands()) {
    EXPECT_EQ(all.count(command), 1U) << command;
    EXPECT_EQ(offered({"flbc", command, "-"}), options_of(command)) << command;
  }
  EXPECT_EQ(offered({"flbc", "solve", "cage.obj", "--mesh"}),
            (Words{"--mesher", "--mesh-timeout"}));
  EXPECT_EQ(offered({"flbc", "solve", "cage.obj", "--phi", ""}),
            (Words{"square", "linear", "sqrt", "constant"}));
  EXPECT_EQ(offered({"flbc", "run", "--pictures", "p"}), (Words{"pdf", "png"}));
  // Files are bash's own business.
  EXPECT_EQ(offered({"flbc", "solve", "c"}), Words{});
  EXPECT_EQ(offered({"flbc", "solve", "cage.obj", "-o", "w"}), Words{});
  EXPECT_EQ(offered({"flbc", "solve", "cage.obj", "--vertices", ""}), Words{});
}

TEST_F(HelpPages, ZshKnowsEveryOption) {
  const auto script = page("_flbc");
  for (const auto& command : commands()) {
    const auto begin = script.find("\n      " + command + ")\n");
    ASSERT_NE(begin, std::string::npos) << command;
    const auto part = script.substr(begin, script.find(";;", begin) - begin);
    for (const auto& option : options_of(command)) {
      EXPECT_NE(part.find(")" + option + "["), std::string::npos) << command << ' ' << option;
    }
  }
  if (!has_program("zsh")) GTEST_SKIP() << "zsh is not installed: its script is not read by it";
  EXPECT_EQ(status_of("zsh -n " + file("_flbc", script)), 0);
}

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
