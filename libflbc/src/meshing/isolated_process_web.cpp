// SPDX-License-Identifier: BSD-3-Clause
// WebAssembly has no processes. A second instance of the module takes their place: it gets a copy
// of the memory that is in use, which the module must import (-sIMPORTED_MEMORY), and whatever
// happens to it, the first one is intact. The functions of the glue code work on the memory of the
// second instance meanwhile. The program that starts the module keeps it as Module.wasmModule, and
// its imports as Module.wasmImports. A time limit has no effect, because there is one thread; the
// page ends the worker instead.
#include <emscripten.h>
#include <emscripten/heap.h>
#include <emscripten/stack.h>

#include <cstdint>
#include <new>

#include "meshing/isolated_process.h"

extern "C" void stackRestore(std::uintptr_t pointer);
extern "C" const char __data_end;  // of the linker; the stack follows, and then the heap

// clang-format off
EM_JS(int, flbc_run_in_copy, (int entry, std::uintptr_t stack, const void* data_end, std::uintptr_t heap_end,
                              const void* work, std::size_t most), {
  const parent = wasmMemory;
  const pages = (memory) => memory.buffer.byteLength / 65536;
  // One memory serves all copies, because nobody knows when the engine would free others.
  const old = Module["copyMemory"];
  const copy = old || new WebAssembly.Memory(
    { initial: pages(parent), maximum: Math.floor((most >>> 0) / 65536) });
  Module["copyMemory"] = copy;
  if (pages(copy) < pages(parent)) copy.grow(pages(parent) - pages(copy));
  const imports = {};
  for (const [name, items] of Object.entries(Module["wasmImports"])) {
    imports[name] = Object.fromEntries(Object.entries(items).map(
      ([key, item]) => [key, item instanceof WebAssembly.Memory ? copy : item]));
  }
  const instance = new WebAssembly.Instance(Module["wasmModule"], imports);
  const table = Object.values(instance.exports).find((item) => item instanceof WebAssembly.Table);
  const bytes = new Uint8Array(copy.buffer);
  bytes.set(HEAPU8.subarray(0, data_end));
  bytes.set(HEAPU8.subarray(stack, heap_end), stack);
  if (old) bytes.fill(0, heap_end);
  const use = (memory) => {
    wasmMemory = memory;
    if (typeof updateMemoryViews == "function") updateMemoryViews();
    else updateGlobalBufferAndViews(memory.buffer);  // of older versions of Emscripten
  };
  Module["sentParts"] = [];
  use(copy);
  try {
    return table.get(entry)(stack, work);
  } catch (error) {
    return error instanceof WebAssembly.Exception ? 1 : -1;
  } finally {
    use(parent);
    if (pages(copy) > 4 * pages(parent)) Module["copyMemory"] = undefined;
  }
});

EM_JS(void, flbc_send, (const void* data, std::size_t size), {
  Module["sentParts"].push(HEAPU8.slice(data, data + size));
});

EM_JS(std::size_t, flbc_sent_size, (), {
  return Module["sentParts"].reduce((sum, part) => sum + part.length, 0);
});

EM_JS(void, flbc_take_sent, (char* to), {
  for (const part of Module["sentParts"]) {
    HEAPU8.set(part, to);
    to += part.length;
  }
  Module["sentParts"] = [];
});
// clang-format on

namespace flbc {
namespace {

enum Outcome { kDone, kThrew, kOutOfMemory };
using Work = std::function<void(const ByteSink&)>;

[[gnu::noinline]] int run(const Work& work) {
  try {
    work(flbc_send);
    return kDone;
  } catch (const std::bad_alloc&) {
    return kOutOfMemory;
  } catch (...) {
    return kThrew;
  }
}

// In the copy. Its stack pointer is that of a fresh instance, so it is set before anything is
// stored.
int enter_copy(std::uintptr_t stack, const Work* work) {
  stackRestore(stack);
  return run(*work);
}

}  // namespace

ProcessOutcome run_isolated(const Work& work, const Patience&) {
  ProcessOutcome outcome;
  const int end = flbc_run_in_copy(static_cast<int>(reinterpret_cast<std::uintptr_t>(&enter_copy)),
                                   emscripten_stack_get_current(), &__data_end,
                                   *emscripten_get_sbrk_ptr(), &work, emscripten_get_heap_max());
  if (end == kOutOfMemory) throw std::bad_alloc();
  if (end != kDone) outcome.end = end == kThrew ? ProcessEnd::kThrew : ProcessEnd::kCrashed;
  outcome.output.resize(flbc_sent_size());
  flbc_take_sent(outcome.output.data());
  return outcome;
}

ProcessOutcome run_isolated(IsolatedFunction function, const std::vector<char>& input,
                            const Patience& patience) {
  return run_isolated([&](const ByteSink& send) { function(input, send); }, patience);
}

std::string describe_signal(int) {
  return "a trap";
}

}  // namespace flbc
