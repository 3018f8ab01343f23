"""Compile the C++ of other people's packages, unmodified, and let each program run for a moment.

python benchmarks/soak/cpp_packages.py FOLDER… [--run SECONDS] [--json FILE] [--jobs N]

A folder is a checkout with packages in it, a workspace of its own. For each package with C++: what
was made, what is left out by name, and the first thing that the compiler says where it fails. With
--run every program is started without arguments, interrupted, and named where a signal ends it.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from gazelle.cpp.building.build import build_package as compile_package
from gazelle.cpp.lookup import host_command, is_node_file
from gazelle.diagnostics import Diagnostics
from gazelle.workspace.building.build import (
    BuildOptions,
    Outcome,
    build_package,
    needs_compiler,
    takes_part_in_cpp,
)
from gazelle.workspace.building.catkin_space import CatkinSpaces, build_catkin_package
from gazelle.workspace.building.compile_step import Compiled, CompileRequest
from gazelle.workspace.building.packages import (
    SourcePackage,
    find_packages,
    in_order,
    needed_by,
)

_PLACE = re.compile(
    r"^(\S+?:\d+:\d+: error: .*|.*(?:fatal error|undefined reference|CMake Error).*)"
)
_LEFT_OUT = re.compile(r"'([^'\n]+)'[^\n]*\[cpp\.target-left-out\]|target '([^'\n]+)' is left out")
_PATIENCE_S = 15.0
_ENDED_BY_US = frozenset({0, -signal.SIGINT, -signal.SIGTERM, 130, 143})


@dataclass
class Result:
    """What became of a package.

    Attributes:
        name: of the package.
        checkout: the folder it was found in.
        seconds: that building took.
        code: of the build.
        made: programs and libraries.
        left_out: targets that are left out by name.
        first_error: the first thing that the compiler or CMake says.
        ended_badly: programs that a signal of their own ended, and which.
        stayed: programs that did not end when interrupted.
    """

    name: str
    checkout: str
    seconds: float = 0.0
    code: int = 0
    made: list[str] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    first_error: str = ""
    ended_badly: dict[str, str] = field(default_factory=dict)
    stayed: list[str] = field(default_factory=list)


def main() -> int:
    """Build, run and print the table; 1 when a package does not build or a program crashes."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--run", type=float, default=0.0, metavar="SECONDS")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--jobs", type=int, default=0)
    parser.add_argument("--only", nargs="*", default=[], help="these packages")
    options = parser.parse_args()
    results = []
    with tempfile.TemporaryDirectory() as top:
        for checkout in options.folders:
            for result in _of_checkout(checkout, Path(top) / checkout.name, options):
                results.append(result)
                print(_row(result), flush=True)
    whole = [one for one in results if not one.code and not one.ended_badly]
    print(f"\n{len(whole)} of {len(results)} packages are whole")
    if options.json:
        text = json.dumps([asdict(one) for one in results], indent=1)
        options.json.write_text(text, encoding="utf-8")
    return int(len(whole) < len(results))


def _of_checkout(checkout: Path, top: Path, options: argparse.Namespace) -> Iterator[Result]:
    packages = in_order(find_packages([checkout.absolute()], Diagnostics()))
    names = needed_by(options.only or [item.name for item in packages], packages)
    spaces = CatkinSpaces(checkout, top / "build", top / "devel", top / "install")
    for package in packages:
        if package.name not in names or not takes_part_in_cpp(package, {}):
            continue
        result = Result(package.name, checkout.name)
        before = set(_binaries(top))
        begin = time.monotonic()
        outcome = _built(package, packages, spaces, options.jobs)
        result.seconds = round(time.monotonic() - begin, 1)
        _note(outcome, result)
        made = sorted(set(_binaries(top)) - before)
        result.made = [path.name for path in made]
        if options.run:
            version = "1" if package.build_type == "catkin" else "2"
            _run_all(made, result, options.run, version)
        if needs_compiler(package, {}):
            yield result


def _built(
    package: SourcePackage, packages: Sequence[SourcePackage], spaces: CatkinSpaces, jobs: int
) -> Outcome:
    """Build a package as catkin_make or colcon build do."""

    def compiled(request: CompileRequest) -> Compiled:
        return compile_package(replace(request, jobs=jobs))

    if package.build_type == "catkin":
        return build_catkin_package(
            package, spaces, {}, installs=False, compile_step=compiled, workspace=packages
        )
    prefixes = tuple(spaces.install / item.name for item in packages)
    return build_package(
        package, BuildOptions(spaces.build, spaces.install, prefixes=prefixes), compiled
    )


def _note(outcome: Outcome, result: Result) -> None:
    result.code = outcome.code
    told = "\n".join((*outcome.errors, *outcome.output))
    result.left_out = sorted({one or other for one, other in _LEFT_OUT.findall(told)})
    if outcome.code:
        found = (line for line in told.splitlines() if _PLACE.match(line.strip()))
        result.first_error = next(found, told.partition("\n")[0]).strip()


def _binaries(top: Path) -> Iterator[Path]:
    for space in ("devel", "install"):
        for path in (top / space).rglob("lib/**/*"):
            if path.is_file() and not path.is_symlink() and path.read_bytes()[:4] == b"\x7fELF":
                yield path


def _run_all(made: Sequence[Path], result: Result, seconds: float, ros_version: str) -> None:
    for program in filter(is_node_file, made):
        process = subprocess.Popen(
            host_command(program),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "ROS_VERSION": ros_version},
        )
        code = _waited(process, seconds)
        if code is None:
            process.send_signal(signal.SIGINT)
            code = _waited(process, _PATIENCE_S)
        if code is None:
            result.stayed.append(program.name)
            process.kill()
            process.wait()
        elif code < 0 and code not in _ENDED_BY_US:
            result.ended_badly[program.name] = signal.Signals(-code).name


def _waited(process: subprocess.Popen[bytes], seconds: float) -> int | None:
    try:
        return process.wait(seconds)
    except subprocess.TimeoutExpired:
        return None


def _row(result: Result) -> str:
    state = "ok" if not result.code else f"FAILS ({result.code})"
    words = [f"{result.checkout}/{result.name}: {state}, {len(result.made)} made"]
    words.append(f"{result.seconds} s")
    if result.left_out:
        words.append(f"left out: {', '.join(result.left_out)}")
    if result.first_error:
        words.append(result.first_error)
    if result.ended_badly:
        words.append(f"ended by a signal: {result.ended_badly}")
    if result.stayed:
        words.append(f"not ended by SIGINT: {', '.join(result.stayed)}")
    return ", ".join(words)


if __name__ == "__main__":
    sys.exit(main())
