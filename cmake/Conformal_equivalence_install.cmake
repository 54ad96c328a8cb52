# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What `cmake --install` copies: the headers, the compiled library if it was built, and the
# package configuration, for find_package(Conformal_equivalence).

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(_package_dir "${CMAKE_INSTALL_DATADIR}/cmake/Conformal_equivalence")

install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h")
install(TARGETS Conformal_equivalence EXPORT Conformal_equivalence_targets)
if(TARGET Conformal_equivalence_compiled)
  install(TARGETS Conformal_equivalence_compiled EXPORT Conformal_equivalence_targets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
endif()
install(EXPORT Conformal_equivalence_targets
        NAMESPACE Conformal_equivalence::
        FILE Conformal_equivalenceTargets.cmake
        DESTINATION "${_package_dir}")

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
  DESTINATION "${_package_dir}")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
