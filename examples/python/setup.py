"""Makes a wheel, or an sdist. CFLAGS are -O3 for any machine, unless the environment has others."""
import os
import re
import shutil
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

# What is compiled lies outside of this folder, in the repository; an sdist has it as it lies there, in a folder of its own.
NEEDED = ["LICENSE", "neuralsvcd.h", "weights.h", "extras/*.h", "examples/verify/*.h", "examples/scenery/*.h",
          "examples/robot/urdf.py"]
OWN = Path("repository")
REPOSITORY = OWN if OWN.exists() else Path("../..")


class SourceDistribution(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for file in (file for pattern in NEEDED for file in REPOSITORY.glob(pattern)):
            copy = Path(base_dir, OWN, file.relative_to(REPOSITORY))
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, copy)


class PythonBuild(build_py):
    def run(self):
        super().run()
        if not getattr(self, "editable_mode", False):
            shutil.copy(REPOSITORY / "examples/robot/urdf.py", Path(self.build_lib, "neuralsvcd", "_urdf.py"))


os.environ.setdefault("CFLAGS", "-O3 -g0")
setup(
    name="neuralsvcd",
    version=re.match(r"// neuralsvcd\.h - v(\S+)", (REPOSITORY / "neuralsvcd.h").read_text()).group(1),
    description="Does this body, moving along this trajectory, hit that body?",
    long_description=Path("README.md").read_text(),
    long_description_content_type="text/markdown",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["neuralsvcd", "nsvcd_verify"],
    package_data={"": ["py.typed"]},
    # An extension is what setuptools can build. These are plain libraries, which the modules open with ctypes, and so
    # they fit every Python, as "abi3" says.
    ext_modules=[Extension(f"{name}._{name}", [f"_{name}.c"], include_dirs=[str(REPOSITORY)], libraries=["m"],
                           py_limited_api=True) for name in ("neuralsvcd", "nsvcd_verify")],
    data_files=[("share/doc/neuralsvcd", [str(REPOSITORY / "LICENSE")])],
    cmdclass={"sdist": SourceDistribution, "build_py": PythonBuild},
    # force: setuptools would not see that the header or CFLAGS have changed.
    options={"build_ext": {"force": True}, "bdist_wheel": {"py_limited_api": "cp39"}},
)
