# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Finds CHOLMOD of SuiteSparse, with or without its own package configuration
# (which SuiteSparse has from version 7 on).
# Sets CHOLMOD_FOUND and CHOLMOD_VERSION, defines the target CHOLMOD::CHOLMOD.

if(NOT TARGET CHOLMOD::CHOLMOD)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse SuiteSparse)
  find_library(CHOLMOD_LIBRARY cholmod)
  mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
endif()

if(CHOLMOD_INCLUDE_DIR)
  foreach(header cholmod.h cholmod_core.h)
    if(EXISTS "${CHOLMOD_INCLUDE_DIR}/${header}" AND NOT CHOLMOD_VERSION)
      file(STRINGS "${CHOLMOD_INCLUDE_DIR}/${header}" lines
           REGEX "^#define[ \t]+CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION[ \t]+[0-9]+")
      string(REGEX REPLACE "[^;]*[ \t]([0-9]+)[ \t]*" "\\1" numbers "${lines}")
      string(REPLACE ";" "." CHOLMOD_VERSION "${numbers}")
    endif()
  endforeach()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD
  REQUIRED_VARS CHOLMOD_LIBRARY CHOLMOD_INCLUDE_DIR
  VERSION_VAR CHOLMOD_VERSION)

if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD UNKNOWN IMPORTED)
  set_target_properties(CHOLMOD::CHOLMOD PROPERTIES
    IMPORTED_LOCATION "${CHOLMOD_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}")
endif()
