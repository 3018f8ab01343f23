"""Expansion of xacro files against the official library, and the cost of its source maps.

Run it as ``python benchmarks/bench_xacro.py [FILE ...]``. Each figure is the best of several
rounds that take turns, so that a busy machine disturbs both alike. Without files three robots are
made up: macros within macros, the same robot as one file of plain XML, and one of YAML values.
"""

from __future__ import annotations

import contextlib
import io
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from gazelle.description.source_maps import remember, source_map_of
from gazelle.description.xacro import Expanded, expand_xacro
from gazelle.diagnostics import Diagnostics

_ROUNDS = 9
_HEAD = '<robot name="big" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
_LINK = """  <link name="{n}"><inertial><mass value="{m}"/>
    <inertia ixx="{m}" ixy="0" ixz="0" iyy="{m}" iyz="0" izz="{m}"/></inertial></link>
  <joint name="{n}_joint" type="fixed"><parent link="base"/><child link="{n}"/>
    <origin xyz="0 {m} 0" rpy="0 0 0"/></joint>
"""


def main() -> None:
    """Print one row for each file."""
    print(
        f"{'ms':<24}{'elements':>9}{'gazelle':>9}{'library':>9}{'ratio':>7}{'map':>7}{'found':>7}"
    )
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_CACHE_HOME"] = folder
        files = [Path(name) for name in sys.argv[1:]] or _robots(Path(folder))
        for file in files:
            _row(file)
        _commands(files[0])


def _row(file: Path) -> None:
    expanded = _expanded(file)
    mine, other = _best(lambda: _expanded(file), lambda: _library(file))
    keep, find = _best(lambda: remember(expanded), lambda: source_map_of(expanded.text))
    times = f"{mine:>9.1f}{other:>9.1f}{mine / other:>7.2f}{keep:>7.1f}{find:>7.1f}"
    print(f"{file.name:<24}{len(expanded.spans):>9}{times}")


def _expanded(file: Path) -> Expanded:
    found = expand_xacro(file, workspace=None, diagnostics=Diagnostics())
    assert found is not None, file
    return found


def _library(file: Path) -> str:
    import xacro

    with contextlib.redirect_stderr(io.StringIO()):
        return str(xacro.process_file(str(file)).toprettyxml(indent="  "))


def _commands(file: Path) -> None:
    """Print the time of the whole programs, start of Python included."""
    official = [sys.executable, "-c", "import xacro; xacro.main()", str(file)]
    mine = [sys.executable, "-m", "gazelle.cli", "xacro", str(file)]
    times = _best(lambda: _run(mine), lambda: _run(official))
    print(f"whole command: {times[0]:.0f} ms, official {times[1]:.0f} ms")


def _run(words: list[str]) -> None:
    subprocess.run(words, check=True, capture_output=True)


def _best(*calls: Callable[[], object]) -> list[float]:
    times = [float("inf")] * len(calls)
    for _ in range(_ROUNDS):
        for index, call in enumerate(calls):
            start = time.perf_counter()
            call()
            times[index] = min(times[index], 1000 * (time.perf_counter() - start))
    return times


def _robots(folder: Path) -> list[Path]:
    links = "".join(_LINK.format(n=f"l{number}", m=number) for number in range(300))
    macro = _LINK.format(n="${name}", m="${mass * scale}")
    calls = "".join(f'<xacro:pair name="p{number}" mass="{number}"/>\n' for number in range(150))
    nested = (
        '<xacro:property name="scale" value="${0.5 + sin(pi/6)}"/>\n'
        f'<xacro:macro name="part" params="name mass">\n{macro}</xacro:macro>\n'
        '<xacro:macro name="pair" params="name mass:=1">\n<xacro:part name="${name}_l" '
        'mass="${mass}"/><xacro:part name="${name}_r" mass="${2 * mass}"/>\n</xacro:macro>\n'
    )
    (folder / "c.yaml").write_text(
        "".join(f"l{number}: {{mass: {number}}}\n" for number in range(50)), encoding="utf-8"
    )
    load = '<xacro:property name="c" value="${xacro.load_yaml(\'c.yaml\')}"/>\n'
    values = "".join(
        _LINK.format(n=f"l{number}", m=f"${{c['l{number}']['mass']}}") for number in range(50)
    )
    texts = {"nested.xacro": nested + calls, "plain.xacro": links, "yaml.xacro": load + values}
    for name, text in texts.items():
        (folder / name).write_text(f"{_HEAD}{text}</robot>\n", encoding="utf-8")
    return [folder / name for name in texts]


if __name__ == "__main__":
    main()
