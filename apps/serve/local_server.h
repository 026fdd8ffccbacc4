// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A page for browsers on this machine.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace flbc::app {

//! Serves a page to browsers on this machine and to nobody else: it listens on the loopback only,
//! its address has a random token, and requests that name another host or come from pages of
//! others are refused.
class LocalServer {
 public:
  //! Listens from now on. \param port  0 = any that is free
  //! \throws IoError if the port cannot be had
  explicit LocalServer(int port);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  //! Of the page: http://127.0.0.1:PORT/TOKEN/
  std::string address() const;

  //! Sets the page. \param make_page  called for every request, by the thread that serves
  void set_page(std::function<std::string()> make_page);

  //! An answer in JSON to what the page posts to NAME beside its address. One is made at a time, by
  //! the thread that serves.
  void set_answer(const std::string& name, std::function<std::string(const std::string&)> answer);

  //! Serves until `is_interrupted` or all pages that were opened are closed.
  void serve(const std::function<bool()>& is_interrupted);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace flbc::app
