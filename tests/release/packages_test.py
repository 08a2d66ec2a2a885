#!/usr/bin/env python3
"""packages_test.py ROOT BUILD WORK [CLEAN]: the Debian packages of a build, installed and used in a clean Debian 12.

debootstrap makes that Debian, or CLEAN, a folder that has one, is copied. A newcomer's steps: apt install ./*.deb, a
light field from nothing to a quilt and to a NumPy array, a C and a C++ program, the conformance suite; then all is
removed again. Lintian says nothing else than SUPPRESSED. Needs root, and a mirror of Debian (HMLFC_DEBIAN_MIRROR).
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

MIRROR = os.environ.get("HMLFC_DEBIAN_MIRROR", "http://deb.debian.org/debian")
SUPPRESSED = (
    "no-changelog",  # that of a Debian package: these come from the project
    "lacks-ldconfig-trigger",  # CPack calls ldconfig in its scripts
)
NAMES = {"hmlfc", "hmlfc-rtl", "hmlfc-vectors", "libhmlfc-dev", "libhmlfc1.0", "python3-hmlfc"}

# Commands that the user of the clean system runs, one after another.
STEPS = """
hmlfc synth --scene cards --grid 3x4 --size 48x32 -o views
hmlfc encode views -o my.hmlfc
hmlfc convert my.hmlfc on_screen_qs2x2a1.5.png --row 1
hmlfc render my.hmlfc -o middle.png
hmlfc conform --filter 'syntax/base-*' --dut /usr/share/hmlfc/vectors/duts/model.json -o report; test $? = 5
hmlfc vectors lint
python3 -c 'import hmlfc, numpy; view = hmlfc.open("my.hmlfc")[1, 2]; assert view.shape == (32, 48, 3)'
python3 /usr/share/hmlfc/tests/naive_decoder/decode.py my.hmlfc -o naive
gcc -std=c99 -pedantic -Wall -Werror decode_view.c $(pkg-config --cflags --libs hmlfc) -o decode_view
./decode_view my.hmlfc 1 2 view.ppm frame.ppm
g++ -std=c++20 decode_block.cpp $(pkg-config --cflags --libs hmlfc) -o decode_block
./decode_block my.hmlfc 0 1 2 3
cmake -S . -B cmake && cmake --build cmake && cmake/decode_view my.hmlfc 1 2 static.ppm frame.ppm
cmp view.ppm static.ppm
hmlfc decode my.hmlfc --view 1,2 -o decoded
hmlfc publish my.hmlfc -o site && test -s site/index.html
"""
LISTS = """cmake_minimum_required(VERSION 3.25)
project(p C CXX)
find_package(hmlfc 1.0 CONFIG REQUIRED)
add_executable(decode_view decode_view.c)
set_target_properties(decode_view PROPERTIES LINKER_LANGUAGE CXX)
target_link_libraries(decode_view PRIVATE hmlfc::hmlfc)
"""


def run(*command, **options):
    """What a command prints; it must succeed."""
    done = subprocess.run([str(word) for word in command], text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, **options)  # fmt: skip
    assert done.returncode == 0, f"{command}: exit status {done.returncode}\n{done.stdout[-4000:]}"
    return done.stdout


class CleanDebian:
    def __init__(self, folder, clean):
        self.folder = folder
        if clean:
            run("cp", "-a", clean, folder)
        else:
            run("debootstrap", "--variant=minbase", "bookworm", folder, MIRROR)
        shutil.copy("/etc/resolv.conf", folder / "etc/resolv.conf")
        run("mount", "-t", "proc", "proc", folder / "proc")
        (folder / "usr/sbin/policy-rc.d").write_text("#!/bin/sh\nexit 101\n")
        self.run("apt-get update")
        self.run("useradd -m newcomer")
        self.home = folder / "home/newcomer"

    def run(self, command, user="root"):
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8"}
        return run("chroot", f"--userspec={user}", self.folder, "bash", "-c", f"cd ~{user} && {command}", env=environment)

    def remove(self):
        subprocess.run(["umount", self.folder / "proc"], capture_output=True)
        if not os.path.ismount(self.folder / "proc"):
            shutil.rmtree(self.folder, ignore_errors=True)

    def install(self, words):
        self.run(f"apt-get install -y --no-install-recommends {words}")


def made_packages(root, build, work):
    """The packages of a build, by their names."""
    run("cpack", "-B", work / "packages", cwd=build)
    debs = {file.name.split("_")[0]: file for file in (work / "packages").glob("*.deb")}
    assert set(debs) == NAMES, sorted(debs)
    return debs


def lint(debs):
    """What Lintian calls an error, apart from SUPPRESSED."""
    told = subprocess.run(["lintian", "--allow-root", "--suppress-tags", ",".join(SUPPRESSED), *debs], text=True,
                          capture_output=True).stdout  # fmt: skip
    return [line for line in told.splitlines() if line.startswith("E:")]


def check_dependencies(debs):
    """Each library that a file needs comes with a package that is named, and nothing of the build is in the files."""
    for name, needs in {
        "libhmlfc1.0": {"libopenjp2-7", "libtbb12", "libhwy1", "libc6"},
        "hmlfc": {"libpng16-16", "libjpeg62-turbo", "libtiff6", "libwebp7", "libssl3", "libfmt9"},
        "libhmlfc-dev": {"libhmlfc1.0", "libexpected-dev"},
        "python3-hmlfc": {"python3-numpy", "libopenjp2-7"},
    }.items():
        told = run("dpkg-deb", "--field", debs[name], "Depends")
        assert needs <= set(re.findall(r"(?:^|, )([\w.+-]+)", told)), (name, told)


def use(debian, root):
    """A newcomer's steps; the pictures are the same by every way."""
    for name in ("decode_view.c", "decode_block.cpp", "mapped_file.hpp"):
        shutil.copy(root / "examples" / name, debian.home)
    (debian.home / "CMakeLists.txt").write_text(LISTS)
    failed = []
    for step in filter(None, STEPS.splitlines()):
        try:
            debian.run(step, user="newcomer")
        except AssertionError as failure:
            failed.append(str(failure))
    assert not failed, "\n".join(failed)
    assert (debian.home / "on_screen_qs2x2a1.5.png").is_file()
    debian.run("pngtopnm decoded/01_02.png > decoded.ppm && cmp decoded.ppm view.ppm", user="newcomer")


def main():
    root, build, work, *clean = (Path(argument).resolve() for argument in sys.argv[1:])
    needed = [tool for tool in ("debootstrap", "lintian", "dpkg-shlibdeps", "chroot") if not shutil.which(tool)]
    if needed or os.geteuid() != 0:
        print("needs root and", *(needed or ["nothing else"]))
        return 77
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    debs = made_packages(root, build, work)
    found = lint(debs.values())
    assert not found, "\n".join(found)
    check_dependencies(debs)
    debian = CleanDebian(work / "debian", clean[0] if clean else None)
    try:
        for file in debs.values():
            shutil.copy(file, debian.folder / "tmp")
        # The tools alone need no headers and no Python.
        debian.install("/tmp/hmlfc_*.deb")
        debian.run("hmlfc --version", user="newcomer")
        debian.install("/tmp/*.deb g++ gcc make cmake pkgconf netpbm")
        use(debian, root)
        debian.run("apt-get purge -y " + " ".join(NAMES))
        left = debian.run("find / -xdev -name '*hmlfc*' -not -path '/tmp/*' -not -path '/home/*' -not -path '/proc/*' "
                          "-not -path '/var/log/*'")  # fmt: skip
        assert not left, left
    finally:
        debian.remove()
    return 0


if __name__ == "__main__":
    sys.exit(main())
