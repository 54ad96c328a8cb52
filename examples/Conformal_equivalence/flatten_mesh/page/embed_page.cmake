# Created by the developers of Conformal_equivalence, in the form of CGAL's packages.
# Makes a C++ source that defines page_template() of page_template.h from the files of this folder:
#   cmake -DOUTPUT=FILE.cpp -P embed_page.cmake
#
# The modules are plain JavaScript modules, so that editors and node understand them. The page is one file, in which they cannot import one
# another; they are put one after another instead, in the order below, without their imports and exports. So an import takes one line, nothing
# is renamed by it, and no two modules have a name in common. Nothing but CMake is needed for that; only the library, three/three.js, is bundled
# beforehand (scripts/bundle_three).

cmake_minimum_required(VERSION 3.12...3.31)

set(modules data quantities shaders surface lines View Overlay picking Histogram theme Instrument panel keyboard main)
set(folder "${CMAKE_CURRENT_LIST_DIR}")

file(READ "${folder}/page.html" page)
file(READ "${folder}/page.css" style)
file(READ "${folder}/three/three.js" library)
set(program "")
foreach(module IN LISTS modules)
  file(READ "${folder}/${module}.js" text)
  string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  string(APPEND program "${text}\n")
endforeach()

# place(MARKER TEXT): puts the text in place of the marker, which is there once. (string(REPLACE) would look at what is in the text.)
macro(place marker text)
  string(FIND "${page}" "${marker}" position)
  string(LENGTH "${marker}" length)
  math(EXPR end "${position} + ${length}")
  string(SUBSTRING "${page}" 0 ${position} before)
  string(SUBSTRING "${page}" ${end} -1 after)
  set(page "${before}${${text}}${after}")
endmacro()
place("<!--STYLE-->" style)
place("<!--THREE-->" library)
place("<!--PROGRAM-->" program)

# Literals of some compilers are short.
set(longest 12000)
set(source "// Made by embed_page.cmake. Do not edit.\n\n#include \"${folder}/../../include/flatten_mesh/page_template.h\"\n\n")
string(APPEND source "namespace flattening {\n\nconst std::vector<std::string_view>& page_template()\n{\n")
string(APPEND source "  static const std::vector<std::string_view> pieces = {\n")
macro(append_pieces text)
  set(rest "${${text}}")
  string(LENGTH "${rest}" length)
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${rest}" ${begin} ${longest} piece)
    string(APPEND source "R\"page_piece(${piece})page_piece\",\n")
    math(EXPR begin "${begin} + ${longest}")
  endwhile()
endmacro()
foreach(marker "<!--TITLE-->" "<!--TITLE-->" "<!--FIGURES-->" "<!--DATA-->") # in their order in the page
  string(FIND "${page}" "${marker}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "page.html has no ${marker} in its place")
  endif()
  string(SUBSTRING "${page}" 0 ${position} before)
  append_pieces(before)
  string(APPEND source "\"${marker}\",\n")
  string(LENGTH "${marker}" length)
  math(EXPR end "${position} + ${length}")
  string(SUBSTRING "${page}" ${end} -1 page)
endforeach()
append_pieces(page)
string(APPEND source "  };\n  return pieces;\n}\n\n} // namespace flattening\n")
file(WRITE "${OUTPUT}" "${source}")
