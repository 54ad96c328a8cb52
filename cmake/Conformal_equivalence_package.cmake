# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Packages of what is installed, by `cpack` in the folder of the build (-G DEB: packages for Debian, one for each component; -G TGZ: archives).
# For users, after `cmake --preset package`, which builds the program optimized and nothing else.

set(CPACK_GENERATOR TGZ)
set(CPACK_PACKAGE_NAME conformal-equivalence)
set(CPACK_PACKAGE_VENDOR "The Conformal_equivalence developers")
set(CPACK_PACKAGE_CONTACT "${CPACK_PACKAGE_VENDOR}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL dev program doc)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
if(NOT TARGET flatten_mesh)
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL program)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libconformal-equivalence-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_DESCRIPTION "C++ headers, with CGAL, that flatten triangle meshes of any topology, and map them to the sphere and to the disk.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libcgal-dev (>= 5.5), libeigen3-dev (>= 3.3), libgmp-dev, libmpfr-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libsuitesparse-dev, libmetis-dev, libtbb-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "flatten-mesh, conformal-equivalence-doc")
if(NOT TARGET Conformal_equivalence_compiled) # headers alone
  set(CPACK_DEBIAN_DEV_PACKAGE_ARCHITECTURE all)
endif()

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME flatten-mesh)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "The program flatten_mesh gives meshes texture coordinates that keep angles, with seams that cannot be seen if asked for.")
find_program(CONFORMAL_EQUIVALENCE_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(CONFORMAL_EQUIVALENCE_SHLIBDEPS)
if(CONFORMAL_EQUIVALENCE_SHLIBDEPS) # what the program is linked with, as Debian calls it
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
endif()

set(CPACK_DEBIAN_DOC_PACKAGE_NAME conformal-equivalence-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_DESCRIPTION "The manual.")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)

include(CPack)
