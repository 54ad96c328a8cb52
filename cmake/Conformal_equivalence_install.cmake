# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What `cmake --install` copies, in three components: `dev`, the headers, the compiled library if it was built, and
# what CMake and pkg-config need to find them; `program`, flatten_mesh with its manual page and what shells complete; `doc`,
# the manual, if scripts/doc has built it.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(_package_dir "${CMAKE_INSTALL_DATADIR}/cmake/Conformal_equivalence")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        COMPONENT dev FILES_MATCHING PATTERN "*.h")
install(TARGETS Conformal_equivalence COMPONENT dev EXPORT Conformal_equivalence_targets)
if(TARGET Conformal_equivalence_compiled)
  install(TARGETS Conformal_equivalence_compiled EXPORT Conformal_equivalence_targets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
endif()
install(EXPORT Conformal_equivalence_targets
        NAMESPACE Conformal_equivalence::
        FILE Conformal_equivalenceTargets.cmake
        DESTINATION "${_package_dir}" COMPONENT dev)

configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/Conformal_equivalenceConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/cmake/Conformal_equivalenceConfig.cmake"
  INSTALL_DESTINATION "${_package_dir}")
set(_any_architecture ARCH_INDEPENDENT)
if(TARGET Conformal_equivalence_compiled)
  set(_any_architecture)
endif()
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/cmake/Conformal_equivalenceConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion
  ${_any_architecture})
install(FILES
  "${PROJECT_BINARY_DIR}/cmake/Conformal_equivalenceConfig.cmake"
  "${PROJECT_BINARY_DIR}/cmake/Conformal_equivalenceConfigVersion.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/Conformal_equivalence_support.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindCHOLMOD.cmake"
  "${PROJECT_SOURCE_DIR}/cmake/FindMETIS.cmake"
  DESTINATION "${_package_dir}" COMPONENT dev)

# relative to the file itself, so that what is installed can be moved
set(_pc_dir "${CMAKE_INSTALL_DATADIR}/pkgconfig")
file(RELATIVE_PATH _pc_prefix "/prefix/${_pc_dir}" "/prefix")
string(REGEX REPLACE "/$" "" _pc_prefix "${_pc_prefix}")
configure_file("${PROJECT_SOURCE_DIR}/cmake/conformal-equivalence.pc.in" "${PROJECT_BINARY_DIR}/cmake/conformal-equivalence.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/cmake/conformal-equivalence.pc" DESTINATION "${_pc_dir}" COMPONENT dev)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT dev)

# ------------------------------------------------------------- the program ----

if(TARGET flatten_mesh)
  # Printed by the program itself, from the table of its options, so that they are complete.
  set(_texts "${PROJECT_BINARY_DIR}/flatten_mesh_texts")
  file(MAKE_DIRECTORY "${_texts}")
  set(_commands)
  foreach(_text IN ITEMS man=flatten_mesh.1 bash=flatten_mesh.bash zsh=_flatten_mesh fish=flatten_mesh.fish)
    string(REPLACE "=" ";" _text "${_text}")
    list(GET _text 0 _kind)
    list(GET _text 1 _file)
    list(APPEND _commands COMMAND flatten_mesh --print ${_kind} > ${_file})
  endforeach()
  add_custom_command(OUTPUT "${_texts}/flatten_mesh.1" BYPRODUCTS "${_texts}/flatten_mesh.bash" "${_texts}/_flatten_mesh" "${_texts}/flatten_mesh.fish"
                     ${_commands} DEPENDS flatten_mesh WORKING_DIRECTORY "${_texts}" VERBATIM)
  add_custom_target(flatten_mesh_texts ALL DEPENDS "${_texts}/flatten_mesh.1")

  set(CONFORMAL_EQUIVALENCE_ZSH_DIR "${CMAKE_INSTALL_DATADIR}/zsh/site-functions" CACHE STRING
      "Where zsh looks for completions (packages of Debian: share/zsh/vendor-completions)")
  mark_as_advanced(CONFORMAL_EQUIVALENCE_ZSH_DIR)

  # It may be that only other targets were built: what is not there is not installed.
  install(TARGETS flatten_mesh RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program OPTIONAL)
  install(FILES "${_texts}/flatten_mesh.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT program OPTIONAL)
  install(FILES "${_texts}/flatten_mesh.bash" RENAME flatten_mesh DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
          COMPONENT program OPTIONAL)
  install(FILES "${_texts}/_flatten_mesh" DESTINATION "${CONFORMAL_EQUIVALENCE_ZSH_DIR}" COMPONENT program OPTIONAL)
  install(FILES "${_texts}/flatten_mesh.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" COMPONENT program OPTIONAL)
  install(FILES "${PROJECT_SOURCE_DIR}/examples/Conformal_equivalence/flatten_mesh/report.schema.json"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/flatten_mesh" COMPONENT program)
  install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/flatten_mesh" COMPONENT program)
endif()

# -------------------------------------------------------------- the manual ----

install(DIRECTORY "${PROJECT_SOURCE_DIR}/build/doc/html" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc OPTIONAL)
install(FILES "${PROJECT_SOURCE_DIR}/CHANGES.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc)
