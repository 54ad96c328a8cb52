# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Brings in the folders test/, examples/ and benchmark/, gives their programs
# include directory, warnings and optional libraries, and runs them by CTest.

link_libraries(Conformal_equivalence::Conformal_equivalence)
if(TARGET Conformal_equivalence::compiled)
  link_libraries(Conformal_equivalence::compiled)
endif()
foreach(_name CHOLMOD METIS TBB)
  if(TARGET Conformal_equivalence::${_name}_support)
    link_libraries(Conformal_equivalence::${_name}_support)
  endif()
endforeach()

# The flags for warnings and sanitizers; see Conformal_equivalence_flags.cmake.
add_compile_options(${CONFORMAL_EQUIVALENCE_COMPILE_FLAGS})
add_link_options(${CONFORMAL_EQUIVALENCE_LINK_FLAGS})

set(_folders)
foreach(_kind test examples benchmark)
  if((_kind STREQUAL "test" AND CONFORMAL_EQUIVALENCE_BUILD_TESTS)
     OR (_kind STREQUAL "examples" AND CONFORMAL_EQUIVALENCE_BUILD_EXAMPLES)
     OR (_kind STREQUAL "benchmark" AND CONFORMAL_EQUIVALENCE_BUILD_BENCHMARKS))
    add_subdirectory(${_kind}/Conformal_equivalence)
    list(APPEND _folders ${_kind})
  endif()
endforeach()

# The program alone, where it does not come with the examples.
if(CONFORMAL_EQUIVALENCE_BUILD_PROGRAM AND NOT TARGET flatten_mesh)
  include(examples/Conformal_equivalence/flatten_mesh/flatten_mesh_program.cmake)
  flatten_mesh_add_library(flatten_mesh_program)
  if(NOT TARGET flatten_mesh_program)
    message(FATAL_ERROR "Conformal_equivalence: flatten_mesh needs Boost.Program_options, which was not found")
  endif()
  add_executable(flatten_mesh examples/Conformal_equivalence/flatten_mesh.cpp)
  target_link_libraries(flatten_mesh PRIVATE flatten_mesh_program)
endif()

# ---------------------------------------------------- precompiled headers ----

# What nearly all programs include of other libraries, precompiled once: that is a third of their time of compiling. Not of this
# package, so that it stays visible what its headers include.
if(CONFORMAL_EQUIVALENCE_PRECOMPILE_HEADERS)
  file(CONFIGURE OUTPUT generated/precompiled_headers.cpp CONTENT "" @ONLY)
  add_library(precompiled_headers OBJECT "${PROJECT_BINARY_DIR}/generated/precompiled_headers.cpp")
  target_compile_definitions(precompiled_headers PRIVATE "CGAL_DATA_DIR=\"${CGAL_DATA_DIR}\"")
  target_precompile_headers(precompiled_headers PRIVATE
    <CGAL/Simple_cartesian.h> <CGAL/Surface_mesh.h> <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
    <CGAL/Eigen_solver_traits.h> <CGAL/Exact_predicates_inexact_constructions_kernel.h>
    <boost/graph/dijkstra_shortest_paths.hpp> <boost/multiprecision/cpp_bin_float.hpp> <boost/property_map/function_property_map.hpp>
    <algorithm> <cmath> <functional> <map> <memory> <random> <set> <sstream> <string> <vector>)
  foreach(_folder IN LISTS _folders)
    get_property(_programs DIRECTORY "${PROJECT_SOURCE_DIR}/${_folder}/Conformal_equivalence" PROPERTY BUILDSYSTEM_TARGETS)
    foreach(_program IN LISTS _programs)
      get_target_property(_type ${_program} TYPE)
      if(_type MATCHES "^(EXECUTABLE|STATIC_LIBRARY|OBJECT_LIBRARY)$")
        target_precompile_headers(${_program} REUSE_FROM precompiled_headers)
        target_compile_definitions(${_program} PRIVATE "CGAL_DATA_DIR=\"${CGAL_DATA_DIR}\"") # CGAL's macro gives it to most
      endif()
    endforeach()
  endforeach()
endif()

# ------------------------------------------------- all headers together ----

if("test" IN_LIST _folders)
  # all_headers: every public header in two translation units of one program, which
  # does not link if a function is not inline. all_headers_once: in one.
  file(GLOB_RECURSE _headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include"
       "${PROJECT_SOURCE_DIR}/include/CGAL/*.h")
  list(FILTER _headers EXCLUDE REGEX "/internal/")
  list(SORT _headers)
  list(TRANSFORM _headers REPLACE "(.+)" "#include <\\1>")
  list(JOIN _headers "\n" _includes)
  file(CONFIGURE OUTPUT generated/all_public_headers.h CONTENT "@_includes@\n" @ONLY)
  file(CONFIGURE OUTPUT generated/all_headers_again.cpp
       CONTENT "#include \"all_public_headers.h\"\n" @ONLY)

  add_library(all_headers_object OBJECT test/Conformal_equivalence/all_headers.cpp)
  target_include_directories(all_headers_object PRIVATE "${PROJECT_BINARY_DIR}/generated")
  add_executable(all_headers_once $<TARGET_OBJECTS:all_headers_object>)
  add_executable(all_headers $<TARGET_OBJECTS:all_headers_object>
                 "${PROJECT_BINARY_DIR}/generated/all_headers_again.cpp")
  target_include_directories(all_headers PRIVATE "${PROJECT_BINARY_DIR}/generated")
endif()

# ------------------------------------------------------------------- tests ----

# Only now, so that what CGAL's macros register in the folders does not run.
enable_testing()

# conformal_equivalence_test(<name> <folder> <command>...)
function(conformal_equivalence_test name folder)
  add_test(NAME ${name} COMMAND ${ARGN})
  set_tests_properties(${name} PROPERTIES
    LABELS "${folder}"
    ENVIRONMENT "CGAL_DATA_DIR=${CGAL_DATA_DIR};UBSAN_OPTIONS=print_stacktrace=1"
    SKIP_RETURN_CODE 77
    TIMEOUT 1200) # some take minutes with sanitizers
  if(name MATCHES "^test_(map_to_sphere|map_to_disk|flatten_retriangulated|common_refinement)$")
    set_tests_properties(${name} PROPERTIES COST 100) # the longest first, so that none is left alone at the end
  endif()
  if(folder STREQUAL "test") # its data/ is beside the sources
    set(working_directory "${PROJECT_SOURCE_DIR}/test/Conformal_equivalence")
  else() # examples may write files; they read CGAL's meshes, and data/ beside the sources
    set(working_directory "${PROJECT_BINARY_DIR}/run/${name}")
    file(MAKE_DIRECTORY "${working_directory}")
    if(EXISTS "${PROJECT_SOURCE_DIR}/${folder}/Conformal_equivalence/data")
      file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}/Conformal_equivalence/data"
           "${working_directory}/data" SYMBOLIC)
    endif()
    if(NOT EXISTS "${CGAL_DATA_DIR}/meshes")
      set_tests_properties(${name} PROPERTIES DISABLED TRUE)
    endif()
  endif()
  set_tests_properties(${name} PROPERTIES WORKING_DIRECTORY "${working_directory}")
endfunction()

# The programs of a folder, each with the arguments in <program>.cmd, as CGAL has them.
function(conformal_equivalence_add_tests folder)
  get_property(programs DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}/Conformal_equivalence"
               PROPERTY BUILDSYSTEM_TARGETS)
  foreach(program IN LISTS programs)
    get_target_property(type ${program} TYPE)
    if(NOT type STREQUAL "EXECUTABLE" OR program MATCHES "^(check|fuzz)_")
      continue()
    endif()
    set(arguments)
    set(arguments_file "${PROJECT_SOURCE_DIR}/${folder}/Conformal_equivalence/${program}.cmd")
    if(EXISTS "${arguments_file}")
      file(STRINGS "${arguments_file}" arguments REGEX "^[^#]" LIMIT_COUNT 1)
      separate_arguments(arguments UNIX_COMMAND "${arguments}")
    elseif(program STREQUAL "flatten_mesh")
      set(arguments --help)
    endif()
    conformal_equivalence_test(${program} ${folder} ${program} ${arguments})
  endforeach()
endfunction()

foreach(_folder IN LISTS _folders)
  if(NOT _folder STREQUAL "benchmark")
    conformal_equivalence_add_tests(${_folder})
  endif()
endforeach()

# The program on a mesh of CGAL, and its files judged by a program that shares no code with it.
function(conformal_equivalence_flatten_and_check _name _mesh)
  cmake_parse_arguments(_options "" "" "FLATTEN;CHECK" ${ARGN})
  set(_outputs -o ${_name}.obj --svg ${_name}.svg)
  if(nlohmann_json_FOUND)
    list(APPEND _outputs --report ${_name}.json)
  endif()
  set(_input "${CGAL_DATA_DIR}/meshes/${_mesh}.off")
  conformal_equivalence_test(flatten_mesh_${_name} examples flatten_mesh "${_input}" ${_options_FLATTEN} ${_outputs})
  if(TARGET check_flattening)
    set(_output "${PROJECT_BINARY_DIR}/run/flatten_mesh_${_name}/${_name}.obj")
    conformal_equivalence_test(check_flattening_${_name} examples check_flattening "${_input}" "${_output}" ${_options_CHECK})
    set_tests_properties(flatten_mesh_${_name} PROPERTIES FIXTURES_SETUP flattened_${_name})
    set_tests_properties(check_flattening_${_name} PROPERTIES FIXTURES_REQUIRED flattened_${_name})
  endif()
endfunction()

# Options, several inputs, pipes and reports, those of the runs above among them.
function(conformal_equivalence_test_program_interface)
  find_program(CONFORMAL_EQUIVALENCE_BASH bash)
  mark_as_advanced(CONFORMAL_EQUIVALENCE_BASH)
  if(NOT CONFORMAL_EQUIVALENCE_BASH)
    message(STATUS "Conformal_equivalence: SKIPPED: program_interface, without bash")
    return()
  endif()
  set(_reports)
  set(_fixtures)
  if(nlohmann_json_FOUND AND EXISTS "${CGAL_DATA_DIR}/meshes")
    foreach(_name lion-head mushroom seamless_bear hexagons_lion-head)
      list(APPEND _reports "${PROJECT_BINARY_DIR}/run/flatten_mesh_${_name}/${_name}.json")
      list(APPEND _fixtures flattened_${_name})
    endforeach()
  endif()
  conformal_equivalence_test(program_interface examples "${CONFORMAL_EQUIVALENCE_BASH}"
    "${PROJECT_SOURCE_DIR}/test/Conformal_equivalence/program_interface/run.sh" $<TARGET_FILE:flatten_mesh> "${PROJECT_SOURCE_DIR}"
    "${CGAL_DATA_DIR}/meshes" ${_reports})
  if(TARGET check_flattening)
    set_tests_properties(program_interface PROPERTIES FIXTURES_REQUIRED "${_fixtures}")
  endif()
endfunction()

if(TARGET flatten_mesh)
  foreach(_mesh lion-head three_peaks mushroom nefertiti mesh_with_border cylinder)
    conformal_equivalence_flatten_and_check(${_mesh} ${_mesh})
  endforeach()
  # a disk, spheres (of the second edges are flipped), and hexagons
  conformal_equivalence_flatten_and_check(seamless_lion-head lion-head FLATTEN --cones auto=5 --seamless CHECK --seamless --free-border)
  conformal_equivalence_flatten_and_check(seamless_bear bear FLATTEN --cones auto=8 --seamless CHECK --seamless)
  conformal_equivalence_flatten_and_check(seamless_camel camel FLATTEN --cones auto=10 --seamless CHECK --seamless)
  conformal_equivalence_flatten_and_check(hexagons_lion-head lion-head FLATTEN --cones auto=5 --quantize 60 --seamless --lattice-coordinates
                                          CHECK --seamless 6 --free-border)
  if("test" IN_LIST _folders AND "examples" IN_LIST _folders)
    conformal_equivalence_test_program_interface()
  endif()
endif()

# What it writes is opened by other programs. Skipped where none of them is there, which is seen when the test runs.
if(TARGET flatten_mesh AND "test" IN_LIST _folders AND UNIX)
  conformal_equivalence_test(other_programs test
                             "${PROJECT_SOURCE_DIR}/test/Conformal_equivalence/other_programs/run" $<TARGET_FILE:flatten_mesh>)
endif()

# The page of --html in headless Chromium. Skipped where that or node is not there, which is seen when the test runs.
if(TARGET flatten_mesh AND "test" IN_LIST _folders AND UNIX)
  conformal_equivalence_test(flatten_mesh_page test
                             "${PROJECT_SOURCE_DIR}/test/Conformal_equivalence/page/run" $<TARGET_FILE:flatten_mesh>)
  set_tests_properties(flatten_mesh_page PROPERTIES TIMEOUT 600)
endif()

if(NOT EXISTS "${CGAL_DATA_DIR}/meshes")
  message(STATUS "Conformal_equivalence: no ${CGAL_DATA_DIR}/meshes (scripts/fetch_data): "
                 "what needs them is skipped")
endif()

if("test" IN_LIST _folders)
  conformal_equivalence_test(all_headers test all_headers)

  add_test(NAME check_style COMMAND "${PROJECT_SOURCE_DIR}/scripts/check_style")
  set_tests_properties(check_style PROPERTIES LABELS style)

  # Calls that must not compile, and what the compiler says to them.
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND TARGET test_signatures)
    add_test(NAME refused_parameters
      COMMAND ${CMAKE_COMMAND}
        "-DCOMPILER=${CMAKE_CXX_COMPILER}"
        "-DFLAGS=${CMAKE_CXX_FLAGS}"
        "-DINCLUDES=$<JOIN:$<TARGET_PROPERTY:test_signatures,INCLUDE_DIRECTORIES>,|>"
        "-DDEFINITIONS=$<JOIN:$<TARGET_PROPERTY:test_signatures,COMPILE_DEFINITIONS>,|>"
        -P "${PROJECT_SOURCE_DIR}/test/Conformal_equivalence/refused_parameters/run.cmake")
    set_tests_properties(refused_parameters PROPERTIES LABELS test TIMEOUT 600)
  endif()

  # Installs, and builds an application that knows nothing but the installed package.
  add_test(NAME installation
    COMMAND ${CMAKE_COMMAND}
      "-DBUILD_DIR=${PROJECT_BINARY_DIR}"
      "-DWITH_LIBRARY=$<TARGET_EXISTS:Conformal_equivalence::compiled>"
      "-DWITH_PROGRAM=$<TARGET_EXISTS:flatten_mesh>"
      "-DVERSION=${PROJECT_VERSION}"
      "-DAPPLICATION=${PROJECT_SOURCE_DIR}/test/Conformal_equivalence/installation"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
      "-DCMAKE_GENERATOR=${CMAKE_GENERATOR}"
      "-DCMAKE_PREFIX_PATH=${CMAKE_PREFIX_PATH}"
      "-DCGAL_DIR=${CGAL_DIR}"
      "-DEigen3_DIR=${Eigen3_DIR}"
      -P "${PROJECT_SOURCE_DIR}/test/Conformal_equivalence/installation/run.cmake")
  set_tests_properties(installation PROPERTIES LABELS installation TIMEOUT 600)
endif()
