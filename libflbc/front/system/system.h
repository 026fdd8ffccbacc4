// SPDX-License-Identifier: BSD-3-Clause
// What the program asks of the system in other ways than the standard library. Only this folder
// includes headers of POSIX or Windows.
#pragma once

#include <memory>
#include <string>

namespace flbc::app {

//! To be called first in main(): limits of the system end in messages rather than in signals, and
//! standard streams that are closed are occupied.
void adapt_to_system();

//! Whether standard error is a terminal.
bool is_terminal();
//! Writes to standard error without buffers, which a mesher's child process would inherit half
//! filled.
void write_to_terminal(const std::string& text);

//! \return why files cannot be made in this folder; empty if they can
std::string why_not_writable(const std::string& folder);

//! Keeps other processes from locking the same folder. Nobody has to remove it: the system drops it
//! with the process.
class FolderLock {
 public:
  //! \throws IoError if another process holds the lock, or the folder cannot be opened
  //! \param command  for the message
  FolderLock(const std::string& folder, const std::string& command);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
};

}  // namespace flbc::app
