// SPDX-License-Identifier: BSD-3-Clause
#include "serve/local_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <future>
#include <list>
#include <map>
#include <mutex>
#include <queue>
#include <random>
#include <utility>
#include <vector>

#include "flbc/errors.h"
#include "serve/http_request.h"

namespace flbc::app {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr const char* kLoopback = "127.0.0.1";
constexpr std::size_t kLongestHead = 16 << 10;
constexpr std::size_t kLongestBody = 16 << 20;
// Whole requests and whole replies; programs on the same machine need far less.
constexpr seconds kLongestExchange(10);
constexpr seconds kLongestDrain(1);
constexpr std::size_t kMostDrained = 1 << 20;
constexpr std::size_t kMostConnections = 512;
// A page that is loaded again is closed for a moment.
constexpr milliseconds kReloading(2500);

// 128 random bits, from the system.
std::string make_token() {
  std::random_device random;
  std::string token;
  for (int k = 0; k < 32; ++k) token += "0123456789abcdef"[random() % 16];
  return token;
}

// The page has everything in itself and talks to its own address only.
constexpr const char* kSafeHeaders =
    "Cache-Control: no-store\r\n"
    "Content-Security-Policy: default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:; connect-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'\r\n"
    "Cross-Origin-Resource-Policy: same-origin\r\n"
    "Referrer-Policy: no-referrer\r\n"
    "X-Content-Type-Options: nosniff\r\n"
    "Connection: close\r\n";

std::string head_of_reply(const std::string& status, const std::string& type) {
  return "HTTP/1.1 " + status + "\r\nContent-Type: " + type + "\r\n" + kSafeHeaders;
}

std::string reply_with(const std::string& status, const std::string& type,
                       const std::string& content) {
  return head_of_reply(status, type) + "Content-Length: " + std::to_string(content.size()) +
         "\r\n\r\n" + content;
}

std::string refusal(const std::string& status) {
  return reply_with(status, "text/plain", status + "\n");
}

// A file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int operator*() const { return number_; }

 private:
  int number_;
};

// Without SO_REUSEPORT, by which another program could listen on the same port.
Descriptor listen_on(int port) {
  Descriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  inet_pton(AF_INET, kLoopback, &address.sin_addr);
  if (*socket < 0 || bind(*socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(*socket, SOMAXCONN) != 0) {
    throw IoError("cannot listen on port " + std::to_string(port) + " of " + kLoopback + ": " +
                  std::strerror(errno));
  }
  return socket;
}

int port_of(const Descriptor& socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  getsockname(*socket, reinterpret_cast<sockaddr*>(&address), &size);
  return ntohs(address.sin_port);
}

// One request and its reply.
struct Connection {
  enum class State { kReadsHead, kReadsBody, kWaits, kWatches, kReplies, kDrains };

  Descriptor socket;
  std::uint64_t id;
  Clock::time_point deadline;
  State state = State::kReadsHead;
  HttpRequest request{};
  std::string received{};
  std::size_t body_begin = 0, body_size = 0;
  std::string reply{};
  std::size_t sent = 0, drained = 0;

  bool has_deadline() const { return state != State::kWaits && state != State::kWatches; }
  short events() const {
    if (state == State::kWaits) return 0;
    return state == State::kReplies ? POLLOUT : POLLIN;
  }
};

}  // namespace

// Connections are the business of one thread, which never waits for a single one of them. Answers
// are made by the thread that serves: each thread that computes gets memory and a team of OpenMP
// threads of its own, and keeps them.
struct LocalServer::State {
  using Answer = std::function<std::string(const std::string&)>;
  using CState = Connection::State;

  struct Task {
    std::uint64_t connection;
    const Answer* answer;
    const char* type;
    std::string body;
  };

  explicit State(int wanted_port)
      : listener(listen_on(wanted_port)),
        wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
        port(port_of(listener)) {
    if (*wake < 0) throw IoError(std::string("cannot make an event: ") + std::strerror(errno));
  }

  std::string prefix() const { return "/" + token + "/"; }

  // ---- the thread of connections --------------------------------------------------------------

  void exchange() {
    for (;;) {
      {
        const std::lock_guard lock(mutex);
        if (ended) return connections.clear();
        for (; !replies.empty(); replies.pop()) take(std::move(replies.front()));
      }
      wait();
      accept_all();
      for (auto& connection : connections) advance(connection);
      for (auto& connection : connections) {
        if (connection.state == CState::kReplies) send_reply(connection);
      }
      remove_closed();
    }
  }

  void wait() {
    polled.assign({{*listener, POLLIN, 0}, {*wake, POLLIN, 0}});
    for (const auto& connection : connections) {
      polled.push_back({*connection.socket, connection.events(), 0});
    }
    constexpr int kLook = 100;  // milliseconds, for deadlines
    poll(polled.data(), polled.size(), kLook);
    std::uint64_t count = 0;
    while (read(*wake, &count, sizeof count) > 0) {
    }
    auto place = polled.begin() + 2;
    closed.clear();
    for (const auto& connection : connections) {
      if (place->revents & (POLLERR | POLLHUP | POLLNVAL)) closed.push_back(connection.id);
      ++place;
    }
  }

  void accept_all() {
    for (;;) {
      Descriptor socket(accept4(*listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
      if (*socket < 0) return;
      if (connections.size() >= kMostConnections && !drop_oldest()) continue;
      connections.push_back(
          {std::move(socket), next_id++, Clock::now() + kLongestExchange, CState::kReadsHead});
    }
  }

  // Of those that have not shown the token. \return whether there was one
  bool drop_oldest() {
    const auto oldest =
        std::find_if(connections.begin(), connections.end(), [](const Connection& connection) {
          return connection.state == CState::kReadsHead || connection.state == CState::kDrains;
        });
    if (oldest == connections.end()) return false;
    connections.erase(oldest);
    return true;
  }

  void remove_closed() {
    const auto now = Clock::now();
    for (auto at = connections.begin(); at != connections.end();) {
      const bool is_late = at->has_deadline() && now > at->deadline;
      const bool is_closed = std::find(closed.begin(), closed.end(), at->id) != closed.end();
      if (!is_late && !is_closed) {
        ++at;
        continue;
      }
      if (at->state == CState::kWatches) count_page(-1);
      at = connections.erase(at);
    }
  }

  // A flood of bytes must not keep the others waiting.
  void advance(Connection& connection) {
    constexpr int kMostPieces = 16;
    char bytes[1 << 16];
    for (int piece = 0; piece < kMostPieces && (connection.events() & POLLIN) != 0; ++piece) {
      const auto count = recv(*connection.socket, bytes, sizeof bytes, 0);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
      if (count <= 0) return closed.push_back(connection.id);
      const bool reads_head = connection.state == CState::kReadsHead;
      if (connection.state == CState::kDrains) {
        connection.drained += static_cast<std::size_t>(count);
        if (connection.drained > kMostDrained) return closed.push_back(connection.id);
      }
      if (!reads_head && connection.state != CState::kReadsBody) continue;  // not of interest
      connection.received.append(bytes, static_cast<std::size_t>(count));
      if (reads_head) read_head(connection);
      if (connection.state == CState::kReadsBody) read_body(connection);
    }
  }

  void read_head(Connection& connection) {
    const auto size = head_size(connection.received);
    if (size.value_or(connection.received.size()) > kLongestHead) {
      return answer_with(connection, refusal("431 Request Header Fields Too Large"));
    }
    if (!size) return;
    const auto request = parse_head(std::string_view(connection.received).substr(0, *size));
    if (!request) return answer_with(connection, refusal("400 Bad Request"));
    connection.request = *request;
    connection.body_begin = *size;
    route(connection);
  }

  // Nothing more is read from those who do not know the token.
  void route(Connection& connection) {
    const auto& request = connection.request;
    if (!is_own(request)) return answer_with(connection, refusal("403 Forbidden"));
    const auto begin = prefix();
    if (request.target.compare(0, begin.size(), begin) != 0) {
      return answer_with(connection, refusal("404 Not Found"));
    }
    const auto name = request.target.substr(begin.size());
    if (request.method == "GET" && name == "alive") return watch(connection);
    if (request.method == "GET" && name.empty() && page) {
      return ask(connection, &page, "text/html; charset=utf-8", {});
    }
    if (request.method != "POST" || answers.count(name) == 0) {
      return answer_with(connection, refusal("404 Not Found"));
    }
    expect_body(connection);
  }

  // A page of another site can send requests here, but not under this name or from this origin.
  bool is_own(const HttpRequest& request) const {
    const auto is_here = [&](const std::string& value, const std::string& scheme) {
      const auto at_port = ":" + std::to_string(port);
      return value == scheme + kLoopback + at_port || value == scheme + "localhost" + at_port;
    };
    const bool has_origin = request.headers.count("origin") > 0;
    return is_here(request.header("host"), "") &&
           (!has_origin || is_here(request.header("origin"), "http://"));
  }

  // Bodies of unknown or coded length could be longer than they seem.
  void expect_body(Connection& connection) {
    const auto& request = connection.request;
    const auto length = request.header("content-length");
    if (request.headers.count("transfer-encoding") > 0 || length.empty()) {
      return answer_with(connection, refusal("411 Length Required"));
    }
    if (request.headers.count("content-encoding") > 0) {
      return answer_with(connection, refusal("415 Unsupported Media Type"));
    }
    const auto* end = length.data() + length.size();
    const auto parsed = std::from_chars(length.data(), end, connection.body_size);
    if (parsed.ec == std::errc::result_out_of_range || connection.body_size > kLongestBody) {
      return answer_with(connection, refusal("413 Payload Too Large"));
    }
    if (parsed.ec != std::errc() || parsed.ptr != end) {
      return answer_with(connection, refusal("400 Bad Request"));
    }
    connection.state = CState::kReadsBody;
  }

  void read_body(Connection& connection) {
    if (connection.received.size() - connection.body_begin < connection.body_size) return;
    const auto name = connection.request.target.substr(prefix().size());
    ask(connection, &answers.at(name), "application/json",
        connection.received.substr(connection.body_begin, connection.body_size));
  }

  void ask(Connection& connection, const Answer* answer, const char* type, std::string body) {
    connection.state = CState::kWaits;
    connection.received = {};
    {
      const std::lock_guard lock(mutex);
      tasks.push({connection.id, answer, type, std::move(body)});
    }
    arrived.notify_one();
  }

  // A reply without end, by which a closed page is noticed.
  void watch(Connection& connection) {
    connection.state = CState::kWatches;
    const auto head = head_of_reply("200 OK", "application/octet-stream") + "\r\n\n";
    if (send(*connection.socket, head.data(), head.size(), MSG_NOSIGNAL) < 0) {
      closed.push_back(connection.id);
    }
    count_page(1);
  }

  // With the lock.
  void take(std::pair<std::uint64_t, std::string> reply) {
    for (auto& connection : connections) {
      if (connection.id == reply.first) answer_with(connection, std::move(reply.second));
    }
  }

  static void answer_with(Connection& connection, std::string reply) {
    connection.reply = std::move(reply);
    connection.received = {};
    connection.state = CState::kReplies;
    connection.deadline = Clock::now() + kLongestExchange;
  }

  void send_reply(Connection& connection) {
    while (connection.sent < connection.reply.size()) {
      const auto count = send(*connection.socket, connection.reply.data() + connection.sent,
                              connection.reply.size() - connection.sent, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
      if (count < 0) return closed.push_back(connection.id);
      connection.sent += static_cast<std::size_t>(count);
    }
    // Closed at once, the reply would be lost with what was not read of the request.
    shutdown(*connection.socket, SHUT_WR);
    connection.reply = {};
    connection.state = CState::kDrains;
    connection.deadline = Clock::now() + kLongestDrain;
  }

  void count_page(int change) {
    const std::lock_guard lock(mutex);
    open_pages += change;
    was_opened = true;
    last_closed = Clock::now();
  }

  // ---- the thread that serves -----------------------------------------------------------------

  bool is_abandoned() {
    const std::lock_guard lock(mutex);
    return was_opened && open_pages == 0 && Clock::now() - last_closed > kReloading;
  }

  // Does what there is to do, and waits for it if there is nothing, but not longer than that.
  void work(milliseconds patience) {
    std::unique_lock lock(mutex);
    if (!arrived.wait_for(lock, patience, [this] { return !tasks.empty(); })) return;
    const auto task = std::move(tasks.front());
    tasks.pop();
    lock.unlock();
    std::string reply;
    try {
      reply = reply_with("200 OK", task.type, (*task.answer)(task.body));
    } catch (const std::exception&) {
      reply = refusal("500 Internal Server Error");
    }
    lock.lock();
    replies.emplace(task.connection, std::move(reply));
    lock.unlock();
    alert();
  }

  void alert() const {
    const std::uint64_t one = 1;
    while (write(*wake, &one, sizeof one) < 0 && errno == EINTR) {
    }
  }

  const Descriptor listener, wake;
  const int port;
  const std::string token = make_token();
  Answer page;
  std::map<std::string, Answer> answers;

  std::list<Connection> connections;
  std::uint64_t next_id = 0;
  std::vector<pollfd> polled;
  std::vector<std::uint64_t> closed;

  std::mutex mutex;  // guards what follows
  std::condition_variable arrived;
  std::queue<Task> tasks;
  std::queue<std::pair<std::uint64_t, std::string>> replies;
  int open_pages = 0;
  bool was_opened = false;
  bool ended = false;
  Clock::time_point last_closed{};
};

LocalServer::LocalServer(int port) : state_(std::make_unique<State>(port)) {
}

LocalServer::~LocalServer() = default;

std::string LocalServer::address() const {
  return std::string("http://") + kLoopback + ":" + std::to_string(state_->port) + state_->prefix();
}

void LocalServer::set_page(std::function<std::string()> make_page) {
  state_->page = [make = std::move(make_page)](const std::string&) { return make(); };
}

void LocalServer::set_answer(const std::string& name,
                             std::function<std::string(const std::string&)> answer) {
  state_->answers[name] = std::move(answer);
}

void LocalServer::serve(const std::function<bool()>& is_interrupted) {
  struct End {
    ~End() {
      {
        const std::lock_guard lock(state.mutex);
        state.ended = true;
      }
      state.alert();
    }
    State& state;
  };
  auto connections = std::async(std::launch::async, [this] { state_->exchange(); });
  {
    const End end{*state_};
    constexpr milliseconds kLook(50);
    while (connections.wait_for(milliseconds(0)) != std::future_status::ready &&
           !is_interrupted() && !state_->is_abandoned()) {
      state_->work(kLook);
    }
  }
  connections.get();  // throws what ended the other thread
}

}  // namespace flbc::app
