# Joins the page's files to one HTML text and writes it as a C++ source:
#   cmake -D FOLDER=... -D MODULES=a,b,c -D OUTPUT=... -P join_page.cmake
# The modules stand in one scope, the ones that others import first, so that import and export are
# left out.
file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/page.css style)
string(REPLACE "," ";" MODULES "${MODULES}")
set(script "")
foreach(module ${MODULES})
  file(READ ${FOLDER}/${module}.mjs text)
  # CMake takes brackets and semicolons in lists for its own; as one string they are safe.
  string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  string(APPEND script "${text}")
endforeach()
string(REPLACE "{{style}}" "${style}" page "${page}")
string(REPLACE "{{script}}" "${script}" page "${page}")

# Compilers limit how long one literal may be.
set(literals "")
string(LENGTH "${page}" length)
set(begin 0)
while(begin LESS length)
  string(SUBSTRING "${page}" ${begin} 8000 piece)
  string(APPEND literals "\n    R\"flbc(${piece})flbc\"")
  math(EXPR begin "${begin} + 8000")
endwhile()
file(WRITE ${OUTPUT} "// Made by join_page.cmake.
namespace flbc::view {

extern const char* const kPageTemplate;

const char* const kPageTemplate =${literals};

}  // namespace flbc::view
")
