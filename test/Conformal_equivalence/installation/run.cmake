# Installs the package of BUILD_DIR, packs it, and unpacks the packages for Debian into a folder of their own, where they must hold what was
# installed. The program is run from there; APPLICATION is configured, built and run with what is there; and a unit without CMake, by the flags
# of pkg-config. What this system has no tools for is skipped, and APPLICATION is built with what was installed.

cmake_minimum_required(VERSION 3.21)

set(prefix "${BUILD_DIR}/installed")
set(packages "${BUILD_DIR}/packages")
set(clean_root "${BUILD_DIR}/clean_root")
set(build "${BUILD_DIR}/application")
file(REMOVE_RECURSE "${prefix}" "${packages}" "${clean_root}" "${build}")

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

function(require_in text part)
  string(FIND "${text}" "${part}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "there is no '${part}' in: ${text}")
  endif()
endfunction()

run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${prefix}")

# ---------------------------------------------------------------- packages ----

find_program(dpkg_deb dpkg-deb)
if(dpkg_deb)
  # (Of other generators than this one, CPack would look through the whole build first.)
  run("${CMAKE_CPACK_COMMAND}" -G DEB -D CPACK_CMAKE_GENERATOR=Ninja -B "${packages}" --config "${BUILD_DIR}/CPackConfig.cmake")
  file(GLOB debs "${packages}/*.deb")
  set(control)
  foreach(deb IN LISTS debs)
    run("${dpkg_deb}" -x "${deb}" "${clean_root}")
    execute_process(COMMAND "${dpkg_deb}" -f "${deb}" OUTPUT_VARIABLE fields COMMAND_ERROR_IS_FATAL ANY)
    string(APPEND control "${fields}")
  endforeach()
  foreach(field IN ITEMS "Package: libconformal-equivalence-dev" "Depends: libcgal-dev" "Package: conformal-equivalence-doc")
    require_in("${control}" "${field}")
  endforeach()
  if(WITH_PROGRAM)
    require_in("${control}" "Package: flatten-mesh")
    require_in("${control}" "libboost-program-options")
  endif()
  file(GLOB_RECURSE installed_files RELATIVE "${prefix}" "${prefix}/*")
  file(GLOB_RECURSE packed_files RELATIVE "${clean_root}/usr" "${clean_root}/usr/*")
  if(NOT installed_files STREQUAL packed_files)
    message(FATAL_ERROR "what was packed is not what was installed")
  endif()
  set(prefix "${clean_root}/usr")
else()
  message("SKIPPED: packages for Debian, without dpkg-deb")
endif()

# ------------------------------------------------------------- the program ----

if(WITH_PROGRAM)
  run("${prefix}/bin/flatten_mesh" --version)
  file(GLOB zsh_file "${prefix}/share/zsh/*/_flatten_mesh")
  foreach(file IN ITEMS "${prefix}/share/man/man1/flatten_mesh.1" "${prefix}/share/bash-completion/completions/flatten_mesh" "${zsh_file}"
          "${prefix}/share/fish/vendor_completions.d/flatten_mesh.fish")
    file(READ "${file}" content)
    require_in("${content}" "lattice")
  endforeach()
  file(WRITE "${build}/tent.off" "OFF\n4 3 0\n0 0 1\n1 0 0\n0 1 0\n-1 -1 0\n3 0 1 2\n3 0 2 3\n3 0 3 1\n")
  run("${prefix}/bin/flatten_mesh" "${build}/tent.off" -o "${build}/%.obj" --quiet)
  file(READ "${build}/tent.obj" content)
  require_in("${content}" "vt ")
endif()

# --------------------------------------------------------------- pkg-config ----

# Only preprocessed: that finds every header, and is fast.
find_program(pkg_config pkg-config)
if(pkg_config)
  set(ENV{PKG_CONFIG_PATH} "${prefix}/share/pkgconfig")
  execute_process(COMMAND "${pkg_config}" --cflags conformal-equivalence OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  run("${pkg_config}" --exact-version=${VERSION} conformal-equivalence)
  execute_process(COMMAND "${pkg_config}" --libs conformal-equivalence OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
  require_in("${libraries}" "-lmpfr -lgmp")
  require_in("${flags}" "${prefix}")
  separate_arguments(flags UNIX_COMMAND "${flags}")
  file(WRITE "${build}/unit.cpp" "#include <CGAL/Conformal_equivalence.h>\n")
  run("${CMAKE_CXX_COMPILER}" ${flags} -E "${build}/unit.cpp" -o "${build}/unit.ii")
else()
  message("SKIPPED: pkg-config")
endif()

# ------------------------------------------------------------------- CMake ----

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
