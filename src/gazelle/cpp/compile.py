"""Compile single files, or the runtime libraries: for those who write the runtime.

``python -m gazelle.cpp.compile talker.cpp -o talker --ros 1``
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

from gazelle.cpp.building.errors import CppBuildError
from gazelle.cpp.building.node_file import node_objects
from gazelle.cpp.building.runtime import ensure_runtime, roots_of
from gazelle.cpp.building.toolchain import find_toolchain
from gazelle.errors import GazelleError

__all__ = ["main"]


def main(arguments: list[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    parser = argparse.ArgumentParser(prog="gazelle.cpp.compile", description=__doc__)
    parser.add_argument("files", nargs="*", type=Path)
    parser.add_argument("-o", dest="output", type=Path)
    parser.add_argument("--ros", type=int, choices=(0, 1, 2), default=1)
    parser.add_argument("--lib", action="append", default=[], help="a further runtime library")
    parser.add_argument("--runtime", nargs="*", help="compile runtime libraries only")
    parser.add_argument("--shared", action="store_true", help="a library, no node")
    parser.add_argument("--flags", action="store_true", help="print the compiler's words")
    parser.add_argument("-f", dest="flag", action="append", default=[], help="-f=-DX")
    options = parser.parse_args(arguments)
    try:
        return _run(options)
    except CppBuildError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    except GazelleError as error:
        sys.stderr.write(f"{error}\n")
        return 2


def _run(options: argparse.Namespace) -> int:
    toolchain = find_toolchain()
    if options.flags:
        words = [*toolchain.link_command, *toolchain.flags, "-Wall", "-Wextra"]
        for root in roots_of(options.ros).values():
            words += ["-isystem", str(root)]
        sys.stdout.write(" ".join([*words, *toolchain.include_flags]) + "\n")
        return 0
    main_library = {0: "core", 1: "roscpp", 2: "rclcpp"}[options.ros]
    names = options.runtime if options.runtime is not None else [main_library, *options.lib]
    runtime = ensure_runtime(names, options.ros, toolchain)
    if options.runtime is not None:
        sys.stdout.writelines(f"{path}\n" for path in runtime.libraries.values())
        return 0
    words = [*toolchain.link_command, *toolchain.flags, "-Wall", "-Wextra"]
    for root in roots_of(options.ros).values():
        words += ["-isystem", str(root)]
    words += [*toolchain.include_flags, *options.flag]
    command = [*words, "-shared", *map(str, options.files)]
    command += [] if options.shared else map(str, node_objects(toolchain))
    libraries = runtime.libraries.values()
    command += [*map(str, libraries), *(f"-Wl,-rpath,{path.parent}" for path in libraries)]
    return subprocess.run(
        [*command, "-Wl,-z,defs", "-o", str(options.output)], check=False
    ).returncode


if __name__ == "__main__":
    raise SystemExit(main())
