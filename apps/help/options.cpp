// SPDX-License-Identifier: BSD-3-Clause
#include "help/options.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

namespace flbc::app {
namespace {

constexpr std::size_t kColumn = 30, kLine = 79;

// The name of a value in the usual form: CLI11 names types.
std::string value_name(const std::string& type) {
  std::string name = type.substr(0, type.find(':'));  // ":POSITIVE" names a check
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') {
    name = name.substr(1, name.size() - 2);
  }
  if (name == "TEXT") return "FILE";
  return name == "FLOAT" || name == "INT" || name == "UINT" ? "N" : name;
}

// A phrase with a capital letter and a period.
std::string as_sentence(std::string phrase) {
  phrase[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(phrase[0])));
  return phrase.back() == '.' ? phrase : phrase + ".";
}

class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    column_width(kColumn);
    label("Positionals", "Arguments");
    label("SUBCOMMAND", "COMMAND");
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    shows_all_ = mode == CLI::AppFormatMode::All;
    auto text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (std::size_t at; (at = text.find("\n\n\n")) != std::string::npos;) text.erase(at, 1);
    return text;
  }

  std::string make_description(const CLI::App* app) const override {
    return as_sentence(app->get_description()) + "\n";
  }

  std::string make_group(std::string group, bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group == kMore && !shows_all_) return "";
    return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text;
    if (option->nonpositional() && option->get_items_expected_max() > 0) {
      const auto value = value_name(option->get_type_name());
      text = option->get_expected_min() == 0 ? " [" + value + "]" : " " + value;
    }
    return option->get_expected_max() > 1 ? text + " ..." : text;
  }

  std::string make_option_desc(const CLI::Option* option) const override {
    const char* const end = option->get_required() && option->nonpositional() ? " (required)" : "";
    return wrapped(option->get_description() + end, kLine - kColumn, "\n");
  }

  std::string make_footer(const CLI::App* app) const override {
    const auto* all = app->get_help_all_ptr();
    const bool leaves_out = all != nullptr && !all->get_group().empty() && !shows_all_;
    return (leaves_out ? "All options: flbc " + app->get_name() + " --help-all\n" : "") +
           CLI::Formatter::make_footer(app);
  }

 private:
  mutable bool shows_all_ = false;
};

}  // namespace

std::shared_ptr<CLI::Formatter> help_formatter() {
  return std::make_shared<HelpFormatter>();
}

void add_help_all(CLI::App& command) {
  const auto groups = command.get_groups();
  const bool has_more = std::find(groups.begin(), groups.end(), kMore) != groups.end();
  command.set_help_all_flag("--help-all", "print all options and exit")
      ->group(has_more ? "Options" : "");
}

CLI::Option* add_choice(CLI::App& command, const std::string& name,
                        const std::vector<std::string>& words,
                        const std::function<void(const std::string&)>& take,
                        const std::string& help) {
  std::string list;
  for (const auto& word : words) list += (list.empty() ? "" : "|") + word;
  const auto choose = [=](const std::string& text) {
    if (std::find(words.begin(), words.end(), text) == words.end()) {
      throw CLI::ValidationError(name, "invalid value '" + text + "'; choose from " + list);
    }
    take(text);
  };
  return command.add_option_function<std::string>(name, choose, help)->type_name(list);
}

std::function<std::string(const std::string&)> in_range(double low, double high) {
  return [=](const std::string& text) {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high)
      return std::string();
    std::ostringstream complaint;
    complaint << "must be from " << low << " to " << high << ", not '" << text << "'";
    return complaint.str();
  };
}

std::string wrapped(const std::string& text, std::size_t width, const std::string& line_break) {
  std::string result;
  std::size_t used = 0;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool breaks = used > 0 && used + 1 + word.size() > width;
    if (used > 0) result += breaks ? line_break : " ";
    used = (breaks || used == 0 ? 0 : used + 1) + word.size();
    result += word;
  }
  return result;
}

}  // namespace flbc::app
