"""What pyproject.toml cannot say: CMake builds the module hmlfc._core, for any Python from 3.11 on.

With HMLFC_STATIC=ON in the environment, what it needs is linked into it, so that one wheel is for any Linux whose C
library is new enough: the tag manylinux says how new.
"""

import os
import platform
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

ROOT = Path(__file__).resolve().parent
BUILD = ROOT / "build"  # which Git ignores
VERSION = re.search(r'HMLFC_VERSION "([^"]*)"', (ROOT / "model/include/hmlfc/version.hpp").read_text())[1]
# What every manylinux has: the C library, its loader, and the library of GCC's own code.
EVERYWHERE = re.compile(r"lib(c|m|gcc_s)\.so\.\d|ld-linux-.*")


class CMakeBuild(build_ext):
    """Builds the target hmlfc_python."""

    def build_extension(self, extension):
        build = Path(self.build_temp).resolve()
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DHMLFC_TESTS=OFF", "-DHMLFC_UNITY=ON",
                   "-DCMAKE_REQUIRE_FIND_PACKAGE_Python=ON", "-DHMLFC_STATIC=" + os.environ.get("HMLFC_STATIC", "OFF")]
        python = f"-DHMLFC_DEBIAN_PYTHON={sys.executable}"
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *options, python], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "hmlfc_python"], check=True)
        (module,) = build.glob("tools/python/hmlfc/_core*.so")
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(module), str(target))


class TaggedWheel(bdist_wheel):
    """A wheel whose name says where it runs."""

    def get_tag(self):
        python, abi, here = super().get_tag()
        (module,) = Path(self.bdist_dir).glob("**/_core*.so")
        return python, abi, platform_of(module) or here


def platform_of(module):
    """The tag manylinux of the oldest system that `module` runs on; None where it needs what not all of them have."""
    told = subprocess.run(["objdump", "-p", module], check=True, capture_output=True, text=True).stdout
    needed = re.findall(r"NEEDED +(\S+)", told)
    versions = [version.rsplit("_", 1) for version in re.findall(r" 0x\w+ 0x\w+ \d+ (\S+)", told)]
    if not all(map(EVERYWHERE.fullmatch, needed)) or {name for name, _ in versions} - {"GLIBC", "GCC"}:
        return None
    major, minor = max(tuple(map(int, number.split(".")))[:2] for name, number in versions if name == "GLIBC")
    return f"manylinux_{major}_{minor}_{platform.machine()}"


BUILD.mkdir(exist_ok=True)
setup(
    version=VERSION,
    ext_modules=[Extension("hmlfc._core", [], py_limited_api=True)],
    cmdclass={"build_ext": CMakeBuild, "bdist_wheel": TaggedWheel},
    options={
        "egg_info": {"egg_base": str(BUILD)},
        "build": {"build_base": str(BUILD / "pip")},
        "bdist_wheel": {"py_limited_api": "cp311"},
    },
)
