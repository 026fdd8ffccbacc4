// SPDX-License-Identifier: BSD-3-Clause
// Windows cannot fork. The other process is the same program, started again with a command line
// that only this file writes and reads: the position of the function in the program, and handles of
// the input (a piece of shared memory) and of the output (a pipe). An object of this file takes
// over before main().
#include "meshing/isolated_process.h"

#ifndef NOMINMAX
#define NOMINMAX
#endif
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <cwchar>
#include <iterator>
#include <memory>
#include <new>
#include <system_error>
#include <thread>

#include "flbc/errors.h"

namespace flbc {
namespace {

// Exit statuses. Those of crashes are large, and that of abort() is 3.
constexpr DWORD kThrew = 101;
constexpr DWORD kNoReader = 102;
constexpr DWORD kOutOfMemory = 103;
constexpr DWORD kTimeIsOver = 104;

constexpr const wchar_t* kMark = L"--flbc-isolated-function";

[[noreturn]] void throw_system_error(const char* action) {
  const auto error = static_cast<int>(GetLastError());
  throw Error(std::string("cannot ") + action +
              " for the mesher: " + std::system_category().message(error));
}

struct Closer {
  using pointer = HANDLE;
  void operator()(HANDLE handle) const {
    if (handle != INVALID_HANDLE_VALUE) CloseHandle(handle);
  }
};
using Handle = std::unique_ptr<HANDLE, Closer>;

std::uintptr_t begin_of_program() {
  return reinterpret_cast<std::uintptr_t>(GetModuleHandleW(nullptr));
}

// ---------------------------------------------------------------------------------- in the child

struct Task {
  IsolatedFunction function;
  HANDLE input;
  HANDLE output;
};

std::vector<char> read_input(HANDLE mapping) {
  const void* const view = MapViewOfFile(mapping, FILE_MAP_READ, 0, 0, 0);
  if (view == nullptr) throw std::bad_alloc();
  std::uint64_t size = 0;
  std::memcpy(&size, view, sizeof size);
  const char* const first = static_cast<const char*>(view) + sizeof size;
  std::vector<char> input(first, first + size);
  UnmapViewOfFile(view);
  return input;
}

void write_all(HANDLE pipe, const void* data, std::size_t size) {
  const char* rest = static_cast<const char*>(data);
  while (size > 0) {
    constexpr std::size_t kMost = 1 << 30;
    DWORD written = 0;
    if (WriteFile(pipe, rest, static_cast<DWORD>(std::min(size, kMost)), &written, nullptr) == 0) {
      TerminateProcess(GetCurrentProcess(), kNoReader);
    }
    rest += written;
    size -= written;
  }
}

DWORD WINAPI run_task(void* data) {
  const auto& task = *static_cast<const Task*>(data);
  try {
    task.function(read_input(task.input), [&](const void* bytes, std::size_t size) {
      write_all(task.output, bytes, size);
    });
  } catch (const std::bad_alloc&) {
    return kOutOfMemory;
  } catch (...) {
    return kThrew;
  }
  return 0;
}

// Without a dialog, and without a debugger that the system may start.
LONG WINAPI end_crashed_process(EXCEPTION_POINTERS* crash) {
  TerminateProcess(GetCurrentProcess(), crash->ExceptionRecord->ExceptionCode);
  return EXCEPTION_EXECUTE_HANDLER;
}

// Meshers recurse deeply. Nothing of the program has begun, so none of it is ended either.
[[noreturn]] void run_and_exit(Task task) {
  SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
  SetUnhandledExceptionFilter(end_crashed_process);
  constexpr SIZE_T kStack = 64 << 20;
  DWORD status = kOutOfMemory;
  const HANDLE thread =
      CreateThread(nullptr, kStack, run_task, &task, STACK_SIZE_PARAM_IS_A_RESERVATION, nullptr);
  if (thread != nullptr) {
    WaitForSingleObject(thread, INFINITE);
    GetExitCodeThread(thread, &status);
  }
  TerminateProcess(GetCurrentProcess(), status);
  std::abort();
}

struct TakeOver {
  TakeOver() {
    const wchar_t* const text = std::wcsstr(GetCommandLineW(), kMark);
    if (text == nullptr) return;
    wchar_t* rest = nullptr;
    const auto function = std::wcstoull(text + std::wcslen(kMark), &rest, 16);
    const auto input = std::wcstoull(rest, &rest, 16);
    const auto output = std::wcstoull(rest, &rest, 16);
    run_and_exit({reinterpret_cast<IsolatedFunction>(begin_of_program() + function),
                  reinterpret_cast<HANDLE>(input), reinterpret_cast<HANDLE>(output)});
  }
};
const TakeOver take_over;

// --------------------------------------------------------------------------------- in the parent

SECURITY_ATTRIBUTES inherited() {
  return {sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
}

// The size, then the bytes.
Handle share(const std::vector<char>& input) {
  auto attributes = inherited();
  const std::uint64_t size = input.size(), total = size + sizeof size;
  Handle mapping(CreateFileMappingW(INVALID_HANDLE_VALUE, &attributes, PAGE_READWRITE,
                                    static_cast<DWORD>(total >> 32), static_cast<DWORD>(total),
                                    nullptr));
  if (!mapping) throw_system_error("share memory");
  void* const view = MapViewOfFile(mapping.get(), FILE_MAP_WRITE, 0, 0, 0);
  if (view == nullptr) throw std::bad_alloc();
  std::memcpy(view, &size, sizeof size);
  std::copy(input.begin(), input.end(), static_cast<char*>(view) + sizeof size);
  UnmapViewOfFile(view);
  return mapping;
}

std::wstring path_of_program() {
  constexpr std::size_t kLongest = 1 << 15;
  std::wstring path(kLongest, L'\0');
  path.resize(GetModuleFileNameW(nullptr, path.data(), static_cast<DWORD>(path.size())));
  return path;
}

// It ends with this process. What it prints is discarded.
Handle start(IsolatedFunction function, HANDLE input, HANDLE output, HANDLE job) {
  const auto place = reinterpret_cast<std::uintptr_t>(function) - begin_of_program();
  wchar_t numbers[80];
  std::swprintf(numbers, std::size(numbers), L" %llx %llx %llx",
                static_cast<unsigned long long>(place),
                static_cast<unsigned long long>(reinterpret_cast<std::uintptr_t>(input)),
                static_cast<unsigned long long>(reinterpret_cast<std::uintptr_t>(output)));
  const std::wstring program = path_of_program();
  std::wstring command = L"\"" + program + L"\" " + kMark + numbers;
  auto attributes = inherited();
  const Handle nothing(CreateFileW(L"NUL", GENERIC_READ | GENERIC_WRITE,
                                   FILE_SHARE_READ | FILE_SHARE_WRITE, &attributes, OPEN_EXISTING,
                                   0, nullptr));
  STARTUPINFOW startup{};
  startup.cb = sizeof startup;
  startup.dwFlags = STARTF_USESTDHANDLES;
  startup.hStdInput = startup.hStdOutput = startup.hStdError = nothing.get();
  PROCESS_INFORMATION child{};
  if (CreateProcessW(program.c_str(), command.data(), nullptr, nullptr, TRUE,
                     CREATE_SUSPENDED | CREATE_NO_WINDOW, nullptr, nullptr, &startup,
                     &child) == 0) {
    throw_system_error("start a process");
  }
  AssignProcessToJobObject(job, child.hProcess);
  ResumeThread(child.hThread);
  CloseHandle(child.hThread);
  return Handle(child.hProcess);
}

Handle make_job() {
  Handle job(CreateJobObjectW(nullptr, nullptr));
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

std::vector<char> read_until_closed(HANDLE pipe) {
  std::vector<char> output, buffer(std::size_t{1} << 16);
  DWORD received = 0;
  while (ReadFile(pipe, buffer.data(), static_cast<DWORD>(buffer.size()), &received, nullptr) !=
         0) {
    output.insert(output.end(), buffer.begin(), buffer.begin() + received);
  }
  return output;
}

}  // namespace

ProcessOutcome run_isolated(IsolatedFunction function, const std::vector<char>& input,
                            const Patience& patience) {
  constexpr double kLongest = 4e6;  // seconds; in milliseconds these are nearly the most of a DWORD
  const auto limit = static_cast<DWORD>(1000 * std::min(patience.seconds, kLongest));
  const auto memory = share(input);
  const auto job = make_job();
  auto attributes = inherited();
  HANDLE ends[2];
  if (CreatePipe(&ends[0], &ends[1], &attributes, 1 << 20) == 0) throw_system_error("open a pipe");
  const Handle reader(ends[0]);
  Handle writer(ends[1]);
  SetHandleInformation(reader.get(), HANDLE_FLAG_INHERIT, 0);
  const auto process = start(function, memory.get(), writer.get(), job.get());
  writer.reset();

  std::thread watch([&] {
    if (WaitForSingleObject(process.get(), limit) == WAIT_TIMEOUT) {
      TerminateProcess(process.get(), kTimeIsOver);
    }
  });
  ProcessOutcome outcome;
  try {
    outcome.output = read_until_closed(reader.get());
  } catch (const std::bad_alloc&) {
    TerminateProcess(process.get(), kOutOfMemory);
  }
  watch.join();
  DWORD status = 0;
  GetExitCodeProcess(process.get(), &status);
  if (status == kOutOfMemory) throw std::bad_alloc();
  if (status == kTimeIsOver) {
    outcome.end = ProcessEnd::kTimedOut;
  } else if (status == kThrew) {
    outcome.end = ProcessEnd::kThrew;
  } else if (status != 0) {
    outcome.end = ProcessEnd::kCrashed;
    outcome.signal = static_cast<int>(status);
  }
  return outcome;
}

std::string describe_signal(int signal) {
  char text[32];
  std::snprintf(text, sizeof text, "exception 0x%08X", static_cast<unsigned>(signal));
  return text;
}

}  // namespace flbc
