# Links and runs programs with nothing but a compiler and pkg-config's flags: headers are looked for,
# and the objects are those of the build CONSUMER.
cmake_policy(VERSION 3.25)  # IN_LIST
file(GLOB_RECURSE pc ${PREFIX}/*/flbc.pc)
cmake_path(GET pc PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder})
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
separate_arguments(components UNIX_COMMAND "${COMPONENTS}")

foreach(name core io ${components})
  set(package flbc)
  if(name IN_LIST components)
    set(package flbc-${name})
  endif()
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs --static ${package}
    OUTPUT_VARIABLE options COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(options UNIX_COMMAND "${options}")
  set(program ${PREFIX}/../use_${name})
  execute_process(
    COMMAND ${COMPILER} -std=c++17 -E ${SOURCES}/use_${name}.cpp ${options} -o /dev/null
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(
    COMMAND ${COMPILER} ${flags} ${CONSUMER}/CMakeFiles/use_${name}.dir/use_${name}.cpp.o ${options}
      -o ${program}
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${program} WORKING_DIRECTORY ${PREFIX}/.. COMMAND_ERROR_IS_FATAL ANY)
endforeach()
