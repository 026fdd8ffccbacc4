// SPDX-License-Identifier: BSD-3-Clause
// The table that flbc check prints, from its JSON.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>

#include "report/check_report.h"
#include "report/properties.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

// "thinnest_place" -> "thinnest place"
std::string in_words(std::string key) {
  std::replace(key.begin(), key.end(), '_', ' ');
  return key;
}

// "0.25, point 7, place (1, 2)"
std::string shown(const Json& fact) {
  if (fact.is_string()) return fact.get<std::string>();
  if (fact.is_number_float()) {
    constexpr int kDigits = 10;  // coordinates far from the origin need them
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", kDigits, fact.get<double>());
    return text;
  }
  if (!fact.is_structured()) return fact.dump();
  std::string text;
  for (const auto& [key, part] : fact.items()) {
    text += text.empty() ? "" : ", ";
    if (fact.is_object() && key != "value") text += in_words(key) + " ";
    text += shown(part);
  }
  return fact.is_array() ? "(" + text + ")" : text;
}

// A row per fact. Lists by control point are in the JSON only.
void add_facts(TextTable& table, const std::string& group, const Json& facts) {
  constexpr std::size_t kMostNumbers = 3;
  for (const auto& [key, fact] : facts.items()) {
    if (fact.is_null()) continue;
    const auto is_object = [](const Json& part) { return part.is_object(); };
    if (fact.is_object() && std::any_of(fact.begin(), fact.end(), is_object)) {
      add_facts(table, in_words(key) + " ", fact);
    } else if (!fact.is_string() && !(fact.is_array() && fact.size() > kMostNumbers)) {
      table.push_back({"  " + group + in_words(key), shown(fact)});
    }
  }
}

void print(std::ostream& out, const std::string& title, const Json& facts,
           const std::vector<std::string>& left_out) {
  auto rest = facts;
  for (const auto& key : left_out) rest.erase(key);
  TextTable table;
  add_facts(table, "", rest);
  out << facts["file"].get<std::string>() << ": " << title << '\n' << to_text(table);
}

void print_cage(std::ostream& out, const Json& cage) {
  const auto& defects = cage["defects"];
  if (defects.empty()) {
    return print(out, "a sound " + cage["dim"].dump() + "D cage", cage,
                 {"dim", "sound", "defects"});
  }
  out << cage["file"].get<std::string>() << ": not a cage, "
      << (defects.size() == kMostDefects ? "at least " : "") << defects.size()
      << (defects.size() == 1 ? " defect\n" : " defects\n");
  for (const auto& defect : defects) out << "  " << defect["message"].get<std::string>() << '\n';
}

void print_model(std::ostream& out, const Json& model) {
  const auto vertices = model["points"].dump() + " vertices";
  const auto title =
      model["outside"] == 0
          ? vertices + ", none outside the cage"
          : model["outside"].dump() + " of " + vertices +
                " are outside the cage; use flbc solve --outside, or make a cage around it with "
                "flbc cage";
  print(out, title, model, {"points", "outside", "first_outside"});
  if (model.contains("note")) out << "  " << model["note"].get<std::string>() << '\n';
}

}  // namespace

void print_check(std::ostream& out, const Json& report) {
  print_cage(out, report["cage"]);
  if (report.contains("model")) print_model(out, report["model"]);
  if (!report.contains("weights")) return;
  const auto& weights = report["weights"];
  const auto& of = weights["domain"] == "" ? report["model"]["file"] : weights["domain"];
  print(out, "weights of " + of.get<std::string>(), weights, {"properties", "violations"});
}

}  // namespace flbc::app
