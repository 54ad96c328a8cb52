# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# An overlay port, which takes the sources that it lies in:
#
#   vcpkg install conformal-equivalence --overlay-ports=packaging/vcpkg/ports

get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

set(VCPKG_BUILD_TYPE release) # headers, and a tool

vcpkg_check_features(OUT_FEATURE_OPTIONS features
  FEATURES
    tools CONFORMAL_EQUIVALENCE_BUILD_PROGRAM)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${features}
    -DCONFORMAL_EQUIVALENCE_BUILD_TESTS=OFF
    -DCONFORMAL_EQUIVALENCE_BUILD_EXAMPLES=OFF
    -DCONFORMAL_EQUIVALENCE_BUILD_COMPILED_LIBRARY=OFF)
vcpkg_cmake_install()

vcpkg_cmake_config_fixup(PACKAGE_NAME Conformal_equivalence CONFIG_PATH share/cmake/Conformal_equivalence)
vcpkg_fixup_pkgconfig()
if("tools" IN_LIST FEATURES)
  vcpkg_copy_tools(TOOL_NAMES flatten_mesh AUTO_CLEAN)
endif()

file(REMOVE_RECURSE
  "${CURRENT_PACKAGES_DIR}/share/cmake"
  "${CURRENT_PACKAGES_DIR}/share/doc"
  "${CURRENT_PACKAGES_DIR}/lib")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
