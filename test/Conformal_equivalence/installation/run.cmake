# Installs the package below BUILD_DIR, then configures, builds and runs APPLICATION with it.

cmake_minimum_required(VERSION 3.21)

set(prefix "${BUILD_DIR}/installed")
set(build "${BUILD_DIR}/application")
file(REMOVE_RECURSE "${prefix}" "${build}")

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}")

set(hints)
foreach(variable CGAL_DIR Eigen3_DIR)
  if(${variable})
    list(APPEND hints "-D${variable}=${${variable}}")
  endif()
endforeach()
list(PREPEND CMAKE_PREFIX_PATH "${prefix}")
list(JOIN CMAKE_PREFIX_PATH "\\;" prefix_path)

run("${CMAKE_COMMAND}" -S "${APPLICATION}" -B "${build}" -G "${CMAKE_GENERATOR}"
    "-DCMAKE_BUILD_TYPE=Release"
    "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
    "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}"
    "-DCMAKE_PREFIX_PATH=${prefix_path}"
    ${hints})
run("${CMAKE_COMMAND}" --build "${build}")
foreach(program application application_with_library)
  if(program STREQUAL "application" OR WITH_LIBRARY)
    run("${build}/${program}")
  endif()
endforeach()
