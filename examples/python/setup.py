"""Makes a wheel. CFLAGS are -O3 for any machine, unless the environment has others."""
import os
import re
from pathlib import Path

from setuptools import Extension, setup

HEADER = Path("../../neuralsvcd.h")

os.environ.setdefault("CFLAGS", "-O3 -g0")
setup(
    name="neuralsvcd",
    version=re.match(r"// neuralsvcd\.h - v(\S+)", HEADER.read_text()).group(1),
    description="Does this body, moving along this trajectory, hit that body?",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    py_modules=["neuralsvcd", "nsvcd_verify"],
    # An extension is what setuptools can build. These are plain libraries, which the modules open with ctypes, and so
    # they fit every Python, as "abi3" says.
    ext_modules=[Extension(name, [f"{name}.c"], libraries=["m"], py_limited_api=True)
                 for name in ("_neuralsvcd", "_nsvcd_verify")],
    data_files=[("share/doc/neuralsvcd", ["../../LICENSE"])],
    # force: setuptools would not see that the header or CFLAGS have changed.
    options={"build_ext": {"force": True}, "bdist_wheel": {"py_limited_api": "cp39"}},
)
