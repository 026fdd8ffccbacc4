// SPDX-License-Identifier: BSD-3-Clause
// Runs code that may crash or hang in a separate process.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace flbc {

//! Writes bytes from the child to the parent. It does not return if the parent has exited.
using ByteSink = std::function<void(const void* data, std::size_t size)>;

enum class ProcessEnd {
  kFinished,  //!< `work` returned
  kThrew,     //!< `work` threw an exception
  kCrashed,   //!< a signal ended the process
  kTimedOut   //!< the process reached the time limit
};

struct ProcessOutcome {
  ProcessEnd end = ProcessEnd::kFinished;
  int signal = 0;            //!< for kCrashed
  std::vector<char> output;  //!< output of the sink; may be incomplete unless kFinished
};

//! Appends to what another process is to read.
inline ByteSink sink_into(std::vector<char>& bytes) {
  return [&bytes](const void* data, std::size_t size) {
    const char* const first = static_cast<const char*>(data);
    bytes.insert(bytes.end(), first, first + size);
  };
}

//! Parses the output of a sink, in the order in which it was written.
class ByteSource {
 public:
  //! \param bytes  must outlive the reader \param refuse  called if the data end early; must throw
  ByteSource(const std::vector<char>& bytes, std::function<void()> refuse)
      : bytes_(bytes), refuse_(std::move(refuse)) {}

  //! Copies the next `count` elements.
  template <class T>
  void take(T* target, std::size_t count) {
    const std::size_t size = sizeof(T) * count;
    if (bytes_.size() - position_ < size) refuse_();
    if (size > 0) std::memcpy(target, bytes_.data() + position_, size);
    position_ += size;
  }

 private:
  const std::vector<char>& bytes_;
  std::function<void()> refuse_;
  std::size_t position_ = 0;
};

//! How a parent waits.
struct Patience {
  Patience(double limit, std::function<void()> function = {})  // NOLINT: a time limit alone is one
      : seconds(limit), poll(std::move(function)) {}

  double seconds;              //!< time limit, > 0
  std::function<void()> poll;  //!< called every 0.1 s; what it throws ends child and wait
};

//! Runs `work` in a forked child with a copy of the memory of the parent. Its output is discarded,
//! and it dumps no core. No process or file descriptor is leaked.
//! \throws Error if the system cannot create a process or pipe; std::bad_alloc if `work` throws it
ProcessOutcome run_isolated(const std::function<void(const ByteSink&)>& work,
                            const Patience& patience);

//! A function that is called in the other process, with a copy of `input`.
using IsolatedFunction = void (*)(const std::vector<char>& input, const ByteSink& send);

//! The same without a copy of the memory, for systems that cannot fork. These have only this one:
//! there the other process is the same program, and the function runs before main().
ProcessOutcome run_isolated(IsolatedFunction function, const std::vector<char>& input,
                            const Patience& patience);

//! "signal 11 (Segmentation fault)".
std::string describe_signal(int signal);

}  // namespace flbc
