# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake -DCOMPILER=... -DFLAGS=... -DINCLUDES=a|b -DDEFINITIONS=A|B -P run.cmake: compiles what must
# not compile, and fails if a message is missing. The compiler stops soon after them, so that
# this costs little more than reading the headers.

separate_arguments(arguments UNIX_COMMAND "${FLAGS}")
string(REPLACE "|" ";" INCLUDES "${INCLUDES}")
foreach(folder IN LISTS INCLUDES)
  list(APPEND arguments -I "${folder}")
endforeach()
string(REPLACE "|" ";" DEFINITIONS "${DEFINITIONS}")
foreach(definition IN LISTS DEFINITIONS)
  list(APPEND arguments "-D${definition}")
endforeach()

set(source "${CMAKE_CURRENT_LIST_DIR}/refused_parameters.cpp")
execute_process(COMMAND "${COMPILER}" ${arguments} -std=c++17 -fsyntax-only -w -fmax-errors=20 "${source}"
                RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_QUIET)
if(status EQUAL 0)
  message(FATAL_ERROR "nothing is refused")
endif()

set(number 0)
file(STRINGS "${source}" messages REGEX "// refused: ")
foreach(text IN LISTS messages)
  string(REGEX REPLACE "^ *// refused: " "" text "${text}")
  string(FIND "${output}" "${text}" position)
  if(position EQUAL -1)
    message(SEND_ERROR "the compiler does not say: ${text}")
  else()
    math(EXPR number "${number} + 1")
  endif()
endforeach()
message("${number} calls are refused")
