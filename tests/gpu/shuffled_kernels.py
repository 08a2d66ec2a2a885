#!/usr/bin/env python3
"""Writes every kernel with its workgroups and their invocations in another order, as SPIR-V for a KernelCode in C++.

OUT/kernels.inc has them all. Workgroup and invocation numbers are exchanged among each other by a permutation
that the specialisation constant of number 100 chooses; in the code it has the value DEFAULT, and a test puts another in its place.
"""

import argparse
import subprocess
import sys
from pathlib import Path

DEFAULT = "0x5EED5EEDu"
LAYOUT = "layout(local_size_x = 64) in;\n"
PERMUTATION = (
    LAYOUT
    + f"""
layout(constant_id = 100) const uint kOrder = {DEFAULT};

uvec2 shuffled_group() {{
  const uint columns = gl_NumWorkGroups.x;
  const uint count = columns * gl_NumWorkGroups.y;
  uint number = gl_WorkGroupID.y * columns + gl_WorkGroupID.x;
  if ((kOrder & 1u) != 0u) number = count - 1u - number;
  const uint step = count % 31u != 0u ? 31u : 1u;
  if ((kOrder & 2u) != 0u) number = (number * step + (kOrder >> 8) % count) % count;
  return uvec2(number % columns, number / columns);
}}

uint shuffled_lane() {{ return gl_LocalInvocationIndex ^ (kOrder >> 2 & 63u); }}
"""
)


def replaced(text: str, old: str, new: str, where: str) -> str:
    if old not in text:
        sys.exit(f"{where} has no {old!r}")
    return text.replace(old, new)


def shuffle(shaders: Path, folder: Path) -> None:
    """Copies the sources, with functions in place of the built-in variables."""
    folder.mkdir(parents=True, exist_ok=True)
    for source in [*shaders.glob("*.glsl"), *shaders.glob("*.comp")]:
        text = source.read_text().replace("gl_WorkGroupID", "shuffled_group()")
        text = text.replace("gl_LocalInvocationIndex", "shuffled_lane()")
        if source.name == "arguments.glsl":
            text = replaced(text, LAYOUT, PERMUTATION, source.name)
        (folder / source.name).write_text(text)


def compiled(glslc: str, source: Path) -> str:
    command = [glslc, "--target-env=vulkan1.2", "-O", "-Werror", "-mfmt=c", source, "-o", "-"]
    words = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return f'{{"{source.stem}", {words}}},\n'


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("glslc")
    parser.add_argument("shaders", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("kernels", nargs="+")
    options = parser.parse_args()
    folder = options.out / "shaders"
    shuffle(options.shaders, folder)
    kernels = [compiled(options.glslc, folder / f"{kernel}.comp") for kernel in options.kernels]
    (options.out / "kernels.inc").write_text("".join(kernels))


if __name__ == "__main__":
    main()
