// SPDX-License-Identifier: BSD-3-Clause
// The only file that knows the HTTP library.
#include "serve/local_server.h"

#include <httplib.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <queue>
#include <random>
#include <thread>
#include <utility>

#include "flbc/errors.h"

namespace flbc::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kLongestRequest = 16 << 20;
// A page that is loaded again is closed for a moment.
constexpr std::chrono::milliseconds kReloading(2500);
constexpr std::chrono::milliseconds kPulse(250);

// 128 random bits, from the system.
std::string make_token() {
  std::random_device random;
  std::string token;
  for (int k = 0; k < 32; ++k) token += "0123456789abcdef"[random() % 16];
  return token;
}

// The page has everything in itself and talks to its own address only.
const httplib::Headers& safe_headers() {
  static const httplib::Headers headers{
      {"Cache-Control", "no-store"},
      {"Content-Security-Policy",
       "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
       "img-src data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
       "frame-ancestors 'none'"},
      {"Cross-Origin-Resource-Policy", "same-origin"},
      {"Referrer-Policy", "no-referrer"},
      {"X-Content-Type-Options", "nosniff"}};
  return headers;
}

// The library compresses what is given to it whole, as densely as it can: on the way to the same
// machine that takes ten times as long as making it. Pieces of known length are sent as they are.
void send(std::string content, const char* type, httplib::Response& response) {
  const auto length = content.size();
  response.set_content_provider(
      length, type,
      [content = std::move(content)](std::size_t from, std::size_t count, httplib::DataSink& sink) {
        return sink.write(content.data() + from, count);
      });
}

// Work for one thread that others wait for: each thread that computes gets memory and a team of
// OpenMP threads of its own, and keeps them.
class Worker {
 public:
  // To be called by any thread. \return nothing once the worker has closed
  std::string ask(std::function<std::string()> make) {
    std::packaged_task<std::string()> task(std::move(make));
    auto made = task.get_future();
    {
      const std::lock_guard lock(mutex_);
      if (closed_) return {};
      tasks_.push(std::move(task));
    }
    arrived_.notify_one();
    return made.get();
  }

  // Does what there is to do, and waits for it if there is nothing, but not longer than that.
  void work(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    if (!arrived_.wait_for(lock, patience, [this] { return !tasks_.empty(); })) return;
    auto task = std::move(tasks_.front());
    tasks_.pop();
    lock.unlock();
    task();
  }

  // Requests that wait are answered, new ones are not accepted.
  void close() {
    {
      const std::lock_guard lock(mutex_);
      closed_ = true;
    }
    for (; !tasks_.empty(); tasks_.pop()) tasks_.front()();
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::queue<std::packaged_task<std::string()>> tasks_;
  bool closed_ = false;
};

}  // namespace

struct LocalServer::State {
  httplib::Server server;
  Worker worker;
  std::string token = make_token();
  int port = 0;
  std::mutex watching;  // guards what follows
  int open_pages = 0;
  bool was_opened = false;
  Clock::time_point last_closed{};
  std::atomic<bool> ended = false;

  std::string prefix() const { return "/" + token + "/"; }

  // A page of another site can send requests here, but not under this name or from this origin.
  bool is_own(const httplib::Request& request) const {
    const auto is_here = [&](const std::string& name, const std::string& scheme) {
      const auto value = request.get_header_value(name);
      const auto at_port = ":" + std::to_string(port);
      return value == scheme + kLoopback + at_port || value == scheme + "localhost" + at_port;
    };
    return is_here("Host", "") && (!request.has_header("Origin") || is_here("Origin", "http://"));
  }

  bool is_abandoned() {
    const std::lock_guard lock(watching);
    return was_opened && open_pages == 0 && Clock::now() - last_closed > kReloading;
  }

  void count_page(int change) {
    const std::lock_guard lock(watching);
    open_pages += change;
    was_opened = true;
    last_closed = Clock::now();
  }

  // A reply without end, which fails as soon as the page is gone.
  void watch(httplib::Response& response) {
    count_page(1);
    response.set_chunked_content_provider(
        "application/octet-stream",  // which is not compressed, and so sent at once
        [this](std::size_t, httplib::DataSink& sink) {
          std::this_thread::sleep_for(kPulse);
          if (ended) {
            sink.done();
            return true;
          }
          return sink.write("\n", 1);
        },
        [this](bool) { count_page(-1); });
  }
};

LocalServer::LocalServer(int port) : state_(std::make_unique<State>()) {
  auto& server = state_->server;
  // Without the library's option by which another program could listen on the same port.
  server.set_socket_options([](socket_t) {});
  server.set_payload_max_length(kLongestRequest);
  server.set_default_headers(safe_headers());
  state_->port = port;
  if (port == 0) {
    state_->port = server.bind_to_any_port(kLoopback);
  } else if (!server.bind_to_port(kLoopback, port)) {
    state_->port = -1;
  }
  if (state_->port <= 0) {
    throw IoError("cannot listen on port " + std::to_string(port) + " of " + kLoopback);
  }
  server.set_pre_routing_handler([this](const auto& request, auto& response) {
    if (state_->is_own(request)) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get(state_->prefix() + "alive",
             [this](const auto&, auto& response) { state_->watch(response); });
}

LocalServer::~LocalServer() = default;

std::string LocalServer::address() const {
  return std::string("http://") + kLoopback + ":" + std::to_string(state_->port) +
         state_->prefix();
}

void LocalServer::set_page(std::function<std::string()> make_page) {
  state_->server.Get(state_->prefix(), [this, make = std::move(make_page)](const auto&,
                                                                          auto& response) {
    send(state_->worker.ask(make), "text/html; charset=utf-8", response);
  });
}

void LocalServer::set_answer(const std::string& name,
                             std::function<std::string(const std::string&)> answer) {
  state_->server.Post(state_->prefix() + name, [this, make = std::move(answer)](
                                                   const auto& request, auto& response) {
    const auto& text = request.body;
    send(state_->worker.ask([&] { return make(text); }), "application/json", response);
  });
}

void LocalServer::serve(const std::function<bool()>& is_interrupted) {
  std::thread listener([this] { state_->server.listen_after_bind(); });
  constexpr std::chrono::milliseconds kLook(50);
  while (!state_->server.is_running()) std::this_thread::sleep_for(kLook);  // else stop() does nothing
  while (!is_interrupted() && !state_->is_abandoned()) state_->worker.work(kLook);
  state_->ended = true;
  state_->worker.close();
  state_->server.stop();
  listener.join();
}

}  // namespace flbc::app
