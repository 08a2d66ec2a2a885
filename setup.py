"""What pyproject.toml cannot say: CMake builds the module hmlfc._core."""

import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
BUILD = ROOT / "build"  # which Git ignores
VERSION = re.search(r'HMLFC_VERSION "([^"]*)"', (ROOT / "model/include/hmlfc/version.hpp").read_text())[1]


class CMakeBuild(build_ext):
    """Builds the target hmlfc_python for the interpreter that runs this."""

    def build_extension(self, extension):
        build = Path(self.build_temp).resolve()
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DHMLFC_TESTS=OFF", "-DHMLFC_UNITY=ON",
                   "-DCMAKE_REQUIRE_FIND_PACKAGE_pybind11=ON"]
        python = f"-DHMLFC_DEBIAN_PYTHON={sys.executable}"
        subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", *options, python], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "hmlfc_python"], check=True)
        (module,) = build.glob("tools/python/hmlfc/_core*.so")
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(module), str(target))


BUILD.mkdir(exist_ok=True)
setup(
    version=VERSION,
    ext_modules=[Extension("hmlfc._core", [])],
    cmdclass={"build_ext": CMakeBuild},
    options={"egg_info": {"egg_base": str(BUILD)}, "build": {"build_base": str(BUILD / "pip")}},
)
