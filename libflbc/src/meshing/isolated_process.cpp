// SPDX-License-Identifier: BSD-3-Clause
#include "meshing/isolated_process.h"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <mutex>
#include <new>

#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "flbc/errors.h"

namespace flbc {

namespace {

constexpr int kExitThrew = 1;
constexpr int kExitNoReader = 2;
constexpr int kExitOutOfMemory = 3;

using Clock = std::chrono::steady_clock;

[[noreturn]] void throw_system_error(const char* action) {
  throw Error(std::string("cannot ") + action + " for the mesher: " + std::strerror(errno));
}

// ---------------------------------------------------------------------------------- in the child

// A child forked from a process with several threads may use the heap and stdio, because the C
// library resets their locks in fork(); but it must not run exit handlers or signal handlers of the
// parent, or flush its buffered output.
void detach_from_parent() {
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP}) {
    std::signal(signal, SIG_DFL);
  }
  std::signal(SIGPIPE, SIG_IGN);  // write() reports it
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);

  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
#ifdef __linux__
  prctl(PR_SET_DUMPABLE, 0);         // core handler programs ignore the limit
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphan if the parent is killed
#endif

  const int null_device = open("/dev/null", O_RDWR);
  if (null_device < 0) _exit(kExitNoReader);
  dup2(null_device, STDOUT_FILENO);
  dup2(null_device, STDERR_FILENO);
  if (null_device > STDERR_FILENO) close(null_device);
}

void write_all(int descriptor, const void* data, std::size_t size) {
  const char* rest = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(descriptor, rest, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) _exit(kExitNoReader);
    rest += written;
    size -= static_cast<std::size_t>(written);
  }
}

// Meshers recurse deeply. Below the usual limit of 8 MiB, the work gets a stack of its own.
bool has_small_stack() {
  constexpr rlim_t kUsual = 8 << 20;
  rlimit limit{};
  return getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < kUsual;
}

void call_on_large_stack(const std::function<void()>& work) {
  constexpr std::size_t kSize = 64 << 20;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kSize);
  const auto start = [](void* call) -> void* {
    (*static_cast<const std::function<void()>*>(call))();
    return nullptr;
  };
  pthread_t thread;
  auto* const call = const_cast<std::function<void()>*>(&work);
  if (pthread_create(&thread, &attributes, start, call) != 0) _exit(kExitOutOfMemory);
  pthread_join(thread, nullptr);
}

[[noreturn]] void run_child(const std::function<void(const ByteSink&)>& work, int pipe_end) {
  detach_from_parent();
  const auto run = [&] {
    try {
      work([pipe_end](const void* data, std::size_t size) { write_all(pipe_end, data, size); });
    } catch (const std::bad_alloc&) {
      _exit(kExitOutOfMemory);
    } catch (...) {
      _exit(kExitThrew);
    }
  };
  has_small_stack() ? call_on_large_stack(run) : run();
  _exit(0);
}

// --------------------------------------------------------------------------------- in the parent

// Closes both ends of a pipe. Keeps errno.
void close_both(const int (&ends)[2]) {
  const int reason = errno;
  close(ends[0]);
  close(ends[1]);
  errno = reason;
}

// In a process whose standard streams are closed, a pipe gets their numbers, and the child would
// replace its ends by the null device.
void move_above_standard_streams(int (&ends)[2]) {
  for (int& end : ends) {
    if (end > STDERR_FILENO) continue;
    const int moved = fcntl(end, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (moved < 0) {
      close_both(ends);
      throw_system_error("open a pipe");
    }
    close(end);
    end = moved;
  }
}

// The child process and its pipe, with RAII cleanup.
class Child {
 public:
  explicit Child(const std::function<void(const ByteSink&)>& work) {
    // Otherwise a child started concurrently by another thread would inherit the write end and keep
    // the pipe open.
    static std::mutex start_mutex;
    const std::lock_guard<std::mutex> lock(start_mutex);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw_system_error("open a pipe");
    move_above_standard_streams(ends);
    process_ = fork();
    if (process_ < 0) {
      close_both(ends);
      throw_system_error("start a process");
    }
    if (process_ == 0) {
      close(ends[0]);
      run_child(work, ends[1]);
    }
    close(ends[1]);
    pipe_ = ends[0];
  }

  ~Child() {
    close(pipe_);
    if (process_ > 0) {
      kill(process_, SIGKILL);
      wait();
    }
  }

  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  //! Reads until the child closes the pipe. \return false if the deadline passed first
  bool read_all(std::vector<char>& output, Clock::time_point deadline,
                const std::function<void()>& poll_caller) {
    std::vector<char> buffer(std::size_t{1} << 16);
    while (true) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
      if (left <= 0) return false;
      if (poll_caller) poll_caller();
      pollfd watched{pipe_, POLLIN, 0};
      const auto pause = std::min<decltype(left)>(left, 100);
      const int ready = poll(&watched, 1, static_cast<int>(pause));
      if (ready < 0 && errno != EINTR) throw_system_error("wait for data");
      if (ready <= 0) continue;
      const ssize_t received = read(pipe_, buffer.data(), buffer.size());
      if (received < 0 && errno != EINTR) throw_system_error("read data");
      if (received == 0) return true;
      if (received > 0) output.insert(output.end(), buffer.begin(), buffer.begin() + received);
    }
  }

  void stop() { kill(process_, SIGKILL); }

  //! \return the status as waitpid() gives it
  int wait() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
  }

 private:
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace

ProcessOutcome run_isolated(const std::function<void(const ByteSink&)>& work,
                            const Patience& patience) {
  constexpr double kLongest = 1e8;  // three years, far below the range of the clock
  const std::chrono::duration<double> limit(std::min(patience.seconds, kLongest));
  const Clock::time_point deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);

  ProcessOutcome outcome;
  Child child(work);
  if (!child.read_all(outcome.output, deadline, patience.poll)) {
    child.stop();
    child.wait();
    outcome.end = ProcessEnd::kTimedOut;
    return outcome;
  }
  const int status = child.wait();
  if (WIFSIGNALED(status)) {
    outcome.end = ProcessEnd::kCrashed;
    outcome.signal = WTERMSIG(status);
  } else if (WIFEXITED(status) && WEXITSTATUS(status) == kExitOutOfMemory) {
    throw std::bad_alloc();
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    outcome.end = ProcessEnd::kThrew;
  }
  return outcome;
}

ProcessOutcome run_isolated(IsolatedFunction function, const std::vector<char>& input,
                            const Patience& patience) {
  return run_isolated([&](const ByteSink& send) { function(input, send); }, patience);
}

std::string describe_signal(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

}  // namespace flbc
