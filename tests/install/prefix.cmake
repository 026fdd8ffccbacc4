# Installs the build into a prefix, moves the prefix away, and makes a copy without components.
set(stage ${WORK}/stage)
file(REMOVE_RECURSE ${stage} ${WORK}/moved ${WORK}/core_only)
execute_process(
  COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${stage} --config ${CONFIG}
  COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${stage} ${WORK}/moved)

file(COPY ${WORK}/moved/ DESTINATION ${WORK}/core_only)
foreach(component cgal caging tetgen openmesh)
  file(GLOB_RECURSE exports ${WORK}/core_only/flbc-${component}*.cmake)
  if(exports)
    file(REMOVE ${exports})
  endif()
endforeach()

if(PROGRAM)
  foreach(file flbc/engines/deform.glsl flbc/engines/deform.wgsl flbc/engines/webgl.html)
    if(NOT EXISTS ${WORK}/moved/share/${file})
      message(FATAL_ERROR "share/${file} is not installed")
    endif()
  endforeach()
endif()

# A file that knows where it was made would not work on another machine.
file(GLOB_RECURSE texts ${WORK}/moved/*.cmake ${WORK}/moved/*.pc ${WORK}/moved/*.h)
foreach(text IN LISTS texts)
  file(STRINGS ${text} lines)
  foreach(place ${stage} ${BUILD})
    string(FIND "${lines}" ${place} found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${text} contains ${place}")
    endif()
  endforeach()
endforeach()
