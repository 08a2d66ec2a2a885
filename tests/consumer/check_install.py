#!/usr/bin/env python3
"""check_install.py CMAKE BUILD_DIR COMPILER LIBDIR: installs the build, moves it, and does with it what its users do.

The examples are built with the static and with the shared library, by find_package and by pkg-config, and run; what
they print and draw is compared with the installed binary.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "docs"))

import links  # noqa: E402

EXAMPLES = ROOT / "examples"
VECTORS = ROOT / "vectors"
STREAM = VECTORS / "real" / "knights-extended.hmlfc"


def run(*command, code=0, **options):
    """Runs a command; returns what it prints. Its exit status must be `code`."""
    done = subprocess.run([str(word) for word in command], text=True, capture_output=True, **options)
    assert done.returncode == code, f"{command}: exit status {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


class Installation:
    def __init__(self, cmake, build, compiler, libdir, work="consumer"):
        self.cmake, self.compiler = cmake, compiler
        self.build = Path(build).resolve()
        self.work = self.build / work
        shutil.rmtree(self.work, ignore_errors=True)
        first = self.work / "prefix"
        run(cmake, "--install", build, "--prefix", first)
        self.prefix = self.work / "moved"
        first.rename(self.prefix)
        self.lib = self.prefix / libdir
        for file in (*self.lib.glob("cmake/**/*.cmake"), *self.lib.glob("pkgconfig/*")):
            assert str(first) not in file.read_text(), f"{file} names the folder it was installed to"
        include = self.prefix / "include" / "hmlfc"
        self.headers = sorted(file for file in include.iterdir() if file.is_file())
        self.gpu_headers = sorted(include.glob("gpu/*"))
        os.environ["PKG_CONFIG_PATH"] = str(self.lib / "pkgconfig")

    def check_headers(self):
        """Each compiles by itself and needs no header that is not installed."""
        flags = run("pkg-config", "--cflags", "hmlfc").split()
        for header in self.headers + self.gpu_headers:
            quoted = re.findall(r'#\s*include\s*"[^"]*"', header.read_text())
            assert not quoted, f"{header.name} includes {quoted}"
            source = f"#include <{header.relative_to(self.prefix / 'include')}>\n"
            strict = ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-x", "c++", "-"]
            run(self.compiler, *flags, *strict, input=source)

    def build_examples(self, name, *options):
        """The examples, by find_package."""
        folder = self.work / name
        options = ["-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={self.compiler}", *options]
        run(self.cmake, "-G", "Ninja", "-S", EXAMPLES, "-B", folder, f"-DCMAKE_PREFIX_PATH={self.prefix}", *options)
        run(self.cmake, "--build", folder)
        return folder

    def refused_components(self, name, *components):
        """Why find_package does not find them."""
        folder = self.work / name
        folder.mkdir()
        text = f"project(p CXX)\nfind_package(hmlfc CONFIG REQUIRED COMPONENTS {' '.join(components)})\n"
        (folder / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\n" + text)
        command = [self.cmake, "-G", "Ninja", "-S", folder, "-B", folder / "out", f"-DCMAKE_PREFIX_PATH={self.prefix}"]
        done = subprocess.run(command, text=True, capture_output=True)
        assert done.returncode != 0, f"{components} were found"
        return " ".join(done.stderr.split())

    def pkg_config_program(self, name, *library, static=()):
        """Example decode_block by pkg-config."""
        flags = run("pkg-config", *static, "--cflags", "--libs", "hmlfc").split()
        if library:
            flags = [flag for flag in flags if flag != "-lhmlfc"]
        program = self.work / name
        search = [f"-L{self.lib}", f"-Wl,-rpath,{self.lib}"]
        run(self.compiler, "-std=c++20", EXAMPLES / "decode_block.cpp", "-o", program, *search, *library, *flags)
        return program

    def hmlfc(self, *arguments, code=0):
        return run(self.prefix / "bin" / "hmlfc", *arguments, code=code)


def check_block(installation, program):
    """Its samples are the last stage of `hmlfc inspect`, its cost the same."""
    shown = run(program, STREAM, 1, 2, 3, 4).splitlines()
    text = installation.hmlfc("inspect", STREAM, "--view", "1,2", "--plane", "Y", "--block", "3,4", "--json")
    report = json.loads(text)
    rows = report["levels"][-1]["stages"]["sample"]["values"]
    assert shown[-2] == "samples: " + " ".join(str(value) for row in rows for value in row), shown[-2]
    assert shown[-1] == "cost: {fields} fields, {bits} bits".format(**report["cost"]), shown[-1]
    assert sum("byte" in line for line in shown) == report["cost"]["fields"]
    run(program, STREAM, 999, 2, 3, 4, code=1)


def check_frame(installation, folder):
    """Its picture is that of `hmlfc render`."""
    run(folder / "render_frame", STREAM, "1.25", "0.5", folder / "frame.ppm")
    installation.hmlfc("render", STREAM, "--camera", "1.25,0.5", "-o", folder / "frame.png")
    ours, theirs = (np.asarray(Image.open(folder / name)) for name in ("frame.ppm", "frame.png"))
    assert ours.shape == theirs.shape and ours.max() > 0 and (ours == theirs).all()
    assert (ours[:, :, 0] != ours[:, :, 2]).any(), "a grey frame would not show swapped channels"
    run(folder / "render_frame", STREAM, "9999", "0", folder / "none.ppm", code=1)
    for place in ("/dev/full", folder / "none" / "frame.ppm"):
        run(folder / "render_frame", STREAM, "1", "0", place, code=1)


def check_c_program(installation, folder):
    """The C99 example, with the compiler's strictest words: its pictures are those of the program."""
    program = folder / "strict_c"
    flags = run("pkg-config", "--cflags", "--libs", "hmlfc").split()
    strict = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror"]
    run("cc", *strict, EXAMPLES / "decode_view.c", "-o", program, f"-Wl,-rpath,{installation.lib}", *flags)
    assert "GLIBCXX" not in run("objdump", "-T", program), "the C program needs the C++ library by itself"
    run(program, STREAM, "1", "2", folder / "view.ppm", folder / "middle.ppm")
    installation.hmlfc("decode", STREAM, "--view", "1,2", "-o", folder / "views")
    installation.hmlfc("render", STREAM, "-o", folder / "middle.png")
    for ours, theirs in (("view.ppm", "views/01_02.png"), ("middle.ppm", "middle.png")):
        ours, theirs = (np.asarray(Image.open(folder / name)) for name in (ours, theirs))
        assert ours.shape == theirs.shape and (ours == theirs).all()
    for arguments, message in (
        ([VECTORS / "error/magic.hmlfc", "1"], "bad_magic in header at byte 0: "),
        ([STREAM, "99"], "bad_request: view 99,2 does not exist: rows 0 to "),
    ):
        done = subprocess.run([program, *arguments, "2", "-", "-"], text=True, capture_output=True)
        assert done.returncode == 1 and done.stderr.startswith(message), done


def check_decoder(installation, name, dut, vector):
    """An example of a decoder passes a vector that must decode and those that are cut, which must be refused."""
    report = installation.work / name
    chosen = ["--suite", VECTORS, "--filter", vector, "--filter", "error/cut-*", "-o", report]
    installation.hmlfc("conform", "--dut", dut, *chosen, code=5)  # vectors were left out
    results = json.loads((report / "report.json").read_text())["runs"][0]["results"]
    passed = {result["id"] for result in results if result["status"] == "pass"}
    assert passed == {vector, "syntax/base-main", *(f"error/{file.stem}" for file in VECTORS.glob("error/cut-*.hmlfc"))}, passed


def check_decode_unit(installation):
    """The core names files that are there, and Verilator, where there is one, reads the list."""
    rtl = installation.prefix / "share" / "hmlfc" / "rtl"
    core = re.findall(r"^      - (\S+?)(?::|$)", (rtl / "hmlfc_decode_unit.core").read_text(), re.M)
    missing = [name for name in core if not (rtl / name).is_file()]
    assert len(core) > 60 and not missing, missing
    if shutil.which("verilator"):
        for unit in ("hmlfc_decode_unit", "hmlfc_view_unit"):
            run("verilator", "--lint-only", "-Wall", rtl / "waivers.vlt", "-F", rtl / "hmlfc_decode_unit.f", "--top-module", unit)


def check_driver(installation):
    """It compiles as C99 without a warning; all of it but JPEG 2000 needs of other libraries only memset."""
    driver = installation.prefix / "share" / "hmlfc" / "rtl" / "driver"
    sources = [file for file in sorted(driver.glob("*.c")) if file.name != "hmlfc_openjpeg.c"]
    flags = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror", "-ffreestanding", "-fno-builtin"]
    objects = installation.work / "driver.o"
    run("cc", *flags, "-O2", "-r", "-nostdlib", "-o", objects, *sources)
    unknown = set(run("nm", "--undefined-only", "--format=just-symbols", objects).split())
    assert len(sources) > 4 and unknown <= {"memset", "_GLOBAL_OFFSET_TABLE_"}, (sources, unknown)
    symbols = run("nm", "--format=posix", objects).splitlines()
    assert not [line for line in symbols if line.split()[1] in "BbDdCc"], "the driver has static data"
    flags = run("pkg-config", "--cflags", "libopenjp2").split()
    run("cc", "-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *flags, driver / "hmlfc_openjpeg.c")


def check_suite(installation):
    """The installed program finds the installed suite, in a folder that has neither suite nor source."""
    elsewhere = installation.work / "elsewhere"
    elsewhere.mkdir()
    hmlfc = installation.prefix / "bin" / "hmlfc"
    suite = installation.prefix / "share" / "hmlfc" / "vectors"
    manifest = json.loads((VECTORS / "manifest.json").read_text())
    assert "no problems" in run(hmlfc, "vectors", "lint", cwd=elsewhere)
    assert f"{manifest['count']} of" in run(hmlfc, "vectors", "list", cwd=elsewhere)
    assert "base-main" in run(hmlfc, "vectors", "explain", "error/magic", cwd=elsewhere)
    for name in ("README.md", "CHANGES.md", "LICENSE"):
        assert (suite / name).is_file(), name
    command = [hmlfc, "conform", "--filter", "error/magic", "-o", "report", "--json", "--dut"]
    report = json.loads(run(*command, suite / "duts" / "model.json", cwd=elsewhere, code=5))
    assert report["runs"][0]["counts"]["pass"] == 2, report["runs"][0]["counts"]
    report = json.loads(run(*command, "false {input} {output}", cwd=elsewhere, code=1))
    assert str(suite) in report["runs"][0]["begin"]["inspect"], report["runs"][0]["begin"]


def check_documents(installation):
    """Links lead somewhere, and the page for newcomers needs nothing but what is installed."""
    data = installation.prefix / "share" / "hmlfc"
    documents = [file.relative_to(data) for folder in ("docs", "vectors") for file in (data / folder).rglob("*.md")]
    dead = [complaint for name in documents for complaint in links.dead_links(data, name)]
    assert len(documents) > 5 and not dead, dead
    page = (data / "docs" / "conformance.md").read_text()
    for target in ("../vectors/README.md", "line_protocol.md", "../examples/wrap_decoder.c", "specification.md#annex-a-errors"):
        assert f"]({target})" in page, target
    assert "`gpu_dut.cpp`" in page and "gpu_ref" not in page, "a link to a file that is not installed"
    assert page.count("./run") == 1, "commands that need the repository"
    for name in re.findall(r"(?<![\w/])(?:examples|vectors)/[\w./-]+\w", page):
        assert (data / name).exists(), name


def check_components(installation):
    """Component gpu is refused together with the shared library, and where it was not built, by name."""
    assert "takes the static library" in installation.refused_components("both", "gpu", "shared")
    package = installation.lib / "cmake" / "hmlfc"
    kept = {file: file.read_bytes() for file in package.glob("hmlfc-gpu*")}
    for file in kept:
        file.unlink()
    assert "was built without component gpu" in installation.refused_components("none", "gpu")
    for file, content in kept.items():
        file.write_bytes(content)


def check_python(installation):
    """The installed package decodes a view; what the build cannot make is not there."""
    package = installation.prefix / "lib" / "python3" / "dist-packages"
    if not package.exists():
        assert not (installation.build / "tools" / "python").exists()
        return
    program = f"import hmlfc; print(hmlfc.__file__, hmlfc.open('{STREAM}')[1, 2].sum())"
    where, total = run("/usr/bin/python3", "-B", "-c", program, env={"PYTHONPATH": str(package)}).split()
    assert where == str(package / "hmlfc" / "__init__.py"), where
    installation.hmlfc("decode", STREAM, "--view", "1,2", "-o", installation.work / "view")
    assert int(total) == int(np.asarray(Image.open(installation.work / "view" / "01_02.png")).sum())


def check_wgsl(installation):
    """The decoder for WebGPU is there as built: its kernels, and what each of its modules imports."""
    built = installation.build / "gpu_ref" / "wgsl"
    folder = installation.prefix / "share" / "hmlfc" / "wgsl"
    names = sorted(file.name for file in built.iterdir()) if built.exists() else []
    assert names == (sorted(file.name for file in folder.iterdir()) if folder.exists() else []), names
    for module in folder.glob("*.js"):
        imported = re.findall(r'from "\./([^"]*)"', module.read_text())
        assert all(name in names for name in imported), f"{module.name} imports {imported}"


def check_alone(installation):
    """As part of another project the library needs OpenJPEG alone: the same block and frame; it installs what it needs."""
    options = ["-DCMAKE_BUILD_TYPE=None", "-DHMLFC_UNITY=ON", "-DHMLFC_WERROR=ON", f"-DHMLFC_SOURCE={ROOT}"]
    hidden = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("TBB", "hwy", "tl-expected")]
    folder = installation.build_examples("alone", *options, *hidden)
    needed = run("readelf", "-d", folder / "decode_block")
    assert "openjp2" in needed and "tbb" not in needed and "hwy" not in needed, needed
    check_block(installation, folder / "decode_block")
    check_frame(installation, folder)
    run(installation.cmake, "--install", folder, "--prefix", folder / "prefix")
    assert (folder / "prefix/include/tl/expected.hpp").is_file()


def main():
    installation = Installation(*sys.argv[1:])
    check_alone(installation)
    check_wgsl(installation)
    check_python(installation)
    check_suite(installation)
    check_documents(installation)
    check_decode_unit(installation)
    check_driver(installation)
    line_decoder = installation.prefix / "share/hmlfc/examples/line_decoder.py"
    check_decoder(installation, "lines", f"lines: python3 -B {line_decoder}", "syntax/base-main")
    check_components(installation)
    installation.check_headers()
    for name, options in {"static": (), "shared": ("-DBUILD_SHARED_LIBS=ON",)}.items():
        folder = installation.build_examples(name, *options)
        needed = run("readelf", "-d", folder / "decode_block")
        assert ("libhmlfc.so" in needed) == (name == "shared"), f"{name}: {needed}"
        check_block(installation, folder / "decode_block")
    check_frame(installation, folder)
    check_c_program(installation, folder)
    check_decoder(installation, "wrapped", folder / "libwrap_decoder.so", "real/cards-main")
    check_block(installation, installation.pkg_config_program("pkg_shared"))
    archive = ["-Wl,--whole-archive", installation.lib / "libhmlfc.a", "-Wl,--no-whole-archive"]
    check_block(installation, installation.pkg_config_program("pkg_static", *archive, static=["--static"]))


if __name__ == "__main__":
    main()
