# Copyright (c) 2026  The Conformal_equivalence developers.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The headers, for Conan 2:  conan create packaging/conan
# (The recipe takes the sources that it lies in.)

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, load

required_conan_version = ">=2.0"


class ConformalEquivalenceConan(ConanFile):
    name = "conformal-equivalence"
    description = "Discrete conformal equivalence of triangle meshes, with CGAL"
    license = "GPL-3.0-or-later"
    topics = ("geometry", "mesh", "parameterization", "cgal", "header-only")
    package_type = "header-library"
    settings = "os", "compiler", "build_type", "arch"
    no_copy_source = True

    def _root(self):
        return os.path.join(self.recipe_folder, os.pardir, os.pardir)

    def set_version(self):
        header = load(self, os.path.join(self._root(), "include", "CGAL", "Conformal_equivalence", "version.h"))
        self.version = re.search(r'CGAL_CONFORMAL_EQUIVALENCE_VERSION "([0-9.]+)"', header).group(1)

    def export_sources(self):
        for pattern in ("LICENSE", "include/*"):
            copy(self, pattern, src=self._root(), dst=self.export_sources_folder)

    def requirements(self):
        # their headers are included by those of the package
        self.requires("cgal/[>=5.5 <7]", transitive_headers=True, transitive_libs=True)
        self.requires("eigen/[>=3.3 <6]", transitive_headers=True)

    def validate(self):
        check_min_cppstd(self, 17)

    def package(self):
        # nothing is built, and no dependency is looked for
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        copy(self, "*.h", src=os.path.join(self.source_folder, "include"), dst=os.path.join(self.package_folder, "include"))

    def package_id(self):
        self.info.clear()

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.defines = ["CGAL_EIGEN3_ENABLED"]
        self.cpp_info.set_property("cmake_file_name", "Conformal_equivalence")
        self.cpp_info.set_property("cmake_target_name", "Conformal_equivalence::Conformal_equivalence")
        self.cpp_info.set_property("pkg_config_name", "conformal-equivalence")
