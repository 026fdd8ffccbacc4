// SPDX-License-Identifier: BSD-3-Clause
// The folder that flbc run or flbc compare fills.
#pragma once

#include <functional>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

namespace flbc::app {

struct RunFiles {
  std::vector<std::string> inputs{};  //!< paths; they are neither replaced nor removed
  std::vector<std::string> names{};   //!< of all files that may be made
  bool force = false;                 //!< these replace files that no earlier run has made
  bool quiet = false;                 //!< nothing is printed
  std::string command{};              //!< that makes them, without flbc
  std::string report{};               //!< name of its report, which lists the files
};

//! Files appear whole or not at all, each as soon as its step has made it. The report lists them:
//! that is how the next run knows which files are its own. An interrupted run leaves a report that
//! lists all that it would have made. Two threads may add files at a time.
class RunFolder {
 public:
  //! Makes the folder if there is none, and removes from it what an earlier run has made, so that
  //! nothing of that passes for a file of this run. All other files stay.
  //! \throws IoError naming the folder if it cannot be used; OptionError if a result would replace an
  //! input, or without force a file that no earlier run has made
  RunFolder(std::string path, const RunFiles& files);

  std::string path_of(const std::string& name) const;

  //! Calls `write` with the path of the file; interrupts wait meanwhile. Then prints the facts.
  //! \param facts  what is worth saying about it; nothing is printed if it is empty
  void add(const std::string& name, const std::string& facts,
           const std::function<void(const std::string& path)>& write);

  //! The same of a text that is there already.
  void add_text(const std::string& name, const std::string& facts, const std::string& text);

  //! Prints a line about a file, or about what stands for several.
  void print(const std::string& name, const std::string& facts) const;

  //! Writes the report, to which a list of all files is added.
  void add_report(nlohmann::ordered_json& report, const std::string& facts);

 private:
  void check_results(const RunFiles& files, const std::vector<std::string>& old) const;
  void remove_old(const RunFiles& files, const std::vector<std::string>& old) const;

  void print_line(const std::string& name, const std::string& facts) const;
  void write_report(const nlohmann::ordered_json& report) const;

  std::string path_;
  std::string report_;
  bool quiet_;
  std::vector<std::string> names_;  // that may be made
  mutable std::mutex mutex_;        // of the next, of writing, and of printing
  std::set<std::string> made_;
};

}  // namespace flbc::app
