# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The flags of what is compiled here: warnings, and sanitizers if asked for. (Not of what is compiled elsewhere with the package.)

set(CONFORMAL_EQUIVALENCE_COMPILE_FLAGS -Wall -Wextra -Wpedantic)
set(CONFORMAL_EQUIVALENCE_LINK_FLAGS)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # wrong, and about Boost.Multiprecision: from -O2 on g++ warns of inlined system headers too
  list(APPEND CONFORMAL_EQUIVALENCE_COMPILE_FLAGS -Wno-maybe-uninitialized)
endif()
if(CONFORMAL_EQUIVALENCE_WARNINGS_AS_ERRORS)
  list(APPEND CONFORMAL_EQUIVALENCE_COMPILE_FLAGS -Werror)
endif()
if(CONFORMAL_EQUIVALENCE_SANITIZERS)
  list(APPEND CONFORMAL_EQUIVALENCE_COMPILE_FLAGS -fsanitize=${CONFORMAL_EQUIVALENCE_SANITIZERS}
       -fno-sanitize-recover=all -fno-omit-frame-pointer)
  list(APPEND CONFORMAL_EQUIVALENCE_LINK_FLAGS -fsanitize=${CONFORMAL_EQUIVALENCE_SANITIZERS})
endif()

function(conformal_equivalence_set_flags target)
  target_compile_options(${target} PRIVATE ${CONFORMAL_EQUIVALENCE_COMPILE_FLAGS})
  target_link_options(${target} PRIVATE ${CONFORMAL_EQUIVALENCE_LINK_FLAGS})
endfunction()
