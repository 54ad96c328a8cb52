# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The optional dependencies: one option and one line of the configuration for
# each. This file is installed too: the package configuration uses it.

# Declares CONFORMAL_EQUIVALENCE_WITH_<name>: AUTO (used if found), ON (required), OFF.
function(conformal_equivalence_declare_option name purpose)
  set(CONFORMAL_EQUIVALENCE_WITH_${name} AUTO CACHE STRING "${name} (${purpose}): AUTO, ON or OFF")
  set_property(CACHE CONFORMAL_EQUIVALENCE_WITH_${name} PROPERTY STRINGS AUTO ON OFF)
endfunction()

# Prints one line, or stops if `name` was demanded and not found.
function(conformal_equivalence_report name package found)
  set(line "Conformal_equivalence: ${name}")
  if(DEFINED CONFORMAL_EQUIVALENCE_WITH_${name}
     AND NOT CONFORMAL_EQUIVALENCE_WITH_${name}
     AND NOT CONFORMAL_EQUIVALENCE_WITH_${name} STREQUAL "AUTO")
    message(STATUS "${line} off")
  elseif(found)
    message(STATUS "${line} found ${${package}_VERSION}")
  elseif(CONFORMAL_EQUIVALENCE_WITH_${name} STREQUAL "AUTO")
    message(STATUS "${line} not found")
  else()
    message(FATAL_ERROR "${line} was asked for and not found")
  endif()
endfunction()

# Sets `result` to whether the optional dependency `name` may be looked for.
function(conformal_equivalence_is_wanted name result)
  if(NOT DEFINED CONFORMAL_EQUIVALENCE_WITH_${name}
     OR CONFORMAL_EQUIVALENCE_WITH_${name} STREQUAL "AUTO"
     OR CONFORMAL_EQUIVALENCE_WITH_${name})
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

# Makes the target Conformal_equivalence::<name>_support, which defines
# CGAL_CONFORMAL_EQUIVALENCE_USE_<name>, if the library `name` is there.
function(conformal_equivalence_add_support name)
  set(library_CHOLMOD CHOLMOD::CHOLMOD)
  set(library_METIS METIS::METIS)
  set(library_TBB TBB::tbb)

  conformal_equivalence_is_wanted(${name} wanted)
  if(wanted AND NOT TARGET Conformal_equivalence::${name}_support)
    find_package(${name} QUIET)
    if(TARGET ${library_${name}})
      find_package(Threads QUIET)
      add_library(Conformal_equivalence::${name}_support INTERFACE IMPORTED GLOBAL)
      set_target_properties(Conformal_equivalence::${name}_support PROPERTIES
        INTERFACE_COMPILE_DEFINITIONS "CGAL_CONFORMAL_EQUIVALENCE_USE_${name}"
        INTERFACE_LINK_LIBRARIES "${library_${name}};${CMAKE_DL_LIBS}") # (CHOLMOD: threads are held by functions that are looked up)
      set_target_properties(${library_${name}} PROPERTIES IMPORTED_GLOBAL TRUE)
    endif()
  endif()

  if(COMMAND conformal_equivalence_print_versions AND NOT CONFORMAL_EQUIVALENCE_QUIET)
    set(found FALSE)
    if(TARGET Conformal_equivalence::${name}_support)
      set(found TRUE)
    endif()
    conformal_equivalence_report(${name} ${name} ${found})
  endif()
endfunction()

# Looks for `package`, which programs may use, and keeps find_package() of the
# folders below from finding it if the option `name` is off.
function(conformal_equivalence_find_tool name package)
  conformal_equivalence_is_wanted(${name} wanted)
  set(${package}_FOUND FALSE)
  if(wanted)
    find_package(${package} QUIET)
  else()
    set(CMAKE_DISABLE_FIND_PACKAGE_${package} TRUE PARENT_SCOPE)
  endif()
  set(${package}_FOUND "${${package}_FOUND}" PARENT_SCOPE)
  conformal_equivalence_report(${name} ${package} "${${package}_FOUND}")
endfunction()

# Prints the versions of what is always needed, as they were really found.
function(conformal_equivalence_print_versions)
  foreach(variable EIGEN3_VERSION Eigen3_VERSION EIGEN3_VERSION_STRING)
    if(NOT eigen AND ${variable})
      set(eigen ${${variable}})
    endif()
  endforeach()
  foreach(variable Boost_VERSION_STRING Boost_VERSION)
    if(NOT boost AND ${variable})
      set(boost ${${variable}})
    endif()
  endforeach()
  message(STATUS "Conformal_equivalence: CGAL ${CGAL_VERSION}, Eigen ${eigen}, Boost ${boost}")
endfunction()
