# Inner loops are compiled for several instruction sets and chosen at run time, so that one binary
# is fast everywhere. They are optimized in every build type, because without inlining the linker
# could mix code for different instruction sets.
include_guard(DIRECTORY)
set(flbc_kernel_flags -O3 -fno-math-errno -fno-trapping-math -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Or GCC 13 and later contract a * b + c in packs of some widths only, so that a result would depend
  # on the slice of a column.
  list(APPEND flbc_kernel_flags --param=avoid-fma-max-bits=0)
endif()

# One kernel of a module: NAME.inl, once for every instruction set.
function(flbc_add_kernel target module name)
  set(flags_baseline "")
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512vl -mavx512dq -mfma)
  set(sets baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND sets avx2 avx512)
  else()
    set(flags_baseline -ffp-contract=fast)
  endif()
  foreach(set IN LISTS sets)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_${set}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT
      "#define FLBC_ISA ${set}\n#include \"${module}/${name}.inl\"\n")
    target_sources(${target} PRIVATE ${source})
    set_source_files_properties(${source} PROPERTIES
      COMPILE_OPTIONS "${flbc_kernel_flags};${flags_${set}}"
      SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  endforeach()
endfunction()
