"""Compiles packages/project/main.c with the package, and asks it."""
import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class NeuralSvcdTest(ConanFile):
    settings = "os", "compiler", "build_type", "arch"
    generators = "CMakeDeps", "CMakeToolchain"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def test(self):
        if can_run(self):
            mug = os.path.join(self.recipe_folder, "..", "..", "..", "examples", "assets", "mug.obj")
            self.run(f'{os.path.join(self.cpp.build.bindir, "with_header")} "{mug}"', env="conanrun")
