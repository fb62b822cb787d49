"""The header for Conan 2, from the checkout that this file is in: `conan create packages/conan`."""
import os
import re

from conan import ConanFile
from conan.tools.files import copy, load


class NeuralSvcd(ConanFile):
    name = "neuralsvcd"
    license = "MIT"
    description = "Does this body, moving along this trajectory, hit that body? A single header that answers with a proof"
    package_type = "header-library"
    settings = "os", "compiler", "build_type", "arch"  # of the test package; the header is one for all
    no_copy_source = True

    def _checkout(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        first_line = load(self, os.path.join(self._checkout(), "neuralsvcd.h")).partition("\n")[0]
        self.version = re.search(r" v(\S+) ", first_line).group(1)

    def export_sources(self):
        for file in ("neuralsvcd.h", "weights.h", "extras/*.h", "LICENSE"):
            copy(self, file, self._checkout(), self.export_sources_folder)

    def package_id(self):
        self.info.clear()

    def package(self):
        copy(self, "*.h", self.source_folder, os.path.join(self.package_folder, "include", "neuralsvcd"))
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.includedirs = [os.path.join("include", "neuralsvcd")]
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        if self.settings.os != "Windows":
            self.cpp_info.system_libs = ["m"]
