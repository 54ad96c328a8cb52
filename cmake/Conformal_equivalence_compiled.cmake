# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Conformal_equivalence::compiled: the engines for `double`, compiled once (internal/compiled.h
# says how). What links it includes the same headers, and compiles in about half of the time.

file(GLOB _sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/Conformal_equivalence/*.cpp")
add_library(Conformal_equivalence_compiled STATIC ${_sources})
add_library(Conformal_equivalence::compiled ALIAS Conformal_equivalence_compiled)
set_target_properties(Conformal_equivalence_compiled PROPERTIES
  EXPORT_NAME compiled
  OUTPUT_NAME Conformal_equivalence
  POSITION_INDEPENDENT_CODE ON)
target_link_libraries(Conformal_equivalence_compiled PUBLIC Conformal_equivalence::Conformal_equivalence)
if(TARGET Conformal_equivalence::TBB_support) # what the library does with threads, programs that link it must do, too
  target_link_libraries(Conformal_equivalence_compiled PUBLIC Conformal_equivalence::TBB_support)
endif()
target_compile_definitions(Conformal_equivalence_compiled INTERFACE CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED)
conformal_equivalence_set_flags(Conformal_equivalence_compiled)
if(CONFORMAL_EQUIVALENCE_SANITIZERS) # most of what tests do is done here: not optimized it would take thrice as long
  target_compile_options(Conformal_equivalence_compiled PRIVATE -O1)
endif()
