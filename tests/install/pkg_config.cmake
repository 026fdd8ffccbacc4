# Links and runs programs with nothing but a compiler and pkg-config's flags: headers are looked for,
# and the objects are those of the build CONSUMER.
file(GLOB_RECURSE pc ${PREFIX}/*/flbc.pc)
cmake_path(GET pc PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder})
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs --static flbc
  OUTPUT_VARIABLE options COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(options UNIX_COMMAND "${options}")
separate_arguments(flags UNIX_COMMAND "${FLAGS}")

foreach(name use_core use_io)
  set(program ${PREFIX}/../${name})
  execute_process(
    COMMAND ${COMPILER} -std=c++17 -E ${SOURCES}/${name}.cpp ${options} -o /dev/null
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(
    COMMAND ${COMPILER} ${flags} ${CONSUMER}/CMakeFiles/${name}.dir/${name}.cpp.o ${options}
      -o ${program}
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${program} WORKING_DIRECTORY ${PREFIX}/.. COMMAND_ERROR_IS_FATAL ANY)
endforeach()
