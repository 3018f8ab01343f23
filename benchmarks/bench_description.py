"""Time to read a robot of 3,500 elements, beside what else reads URDF.

Run ``python benchmarks/bench_description.py [--links N] [--peers PYTHON]``. PYTHON is another
interpreter that has ``urdf_parser_py`` and ``yourdfpy``; ``check_urdf`` is run when it is on the
PATH. Prints one JSON object per measurement: the best of several runs in milliseconds, and how many
times as long as Python's own XML parser that is.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import numpy as np

from gazelle.description.loader import load_models
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics

_PEERS = {
    "urdf_parser_py": "from urdf_parser_py.urdf import URDF; read = URDF.from_xml_file",
    "yourdfpy": "import yourdfpy; read = lambda f: yourdfpy.URDF.load("
    "f, load_meshes=False, build_scene_graph=False)",
}
_PEER = """
import sys, time
{setup}
best = 1e9
for _ in range(5):
    start = time.perf_counter(); read(sys.argv[1]); best = min(best, time.perf_counter() - start)
print(best * 1e3)
"""
_MODULES = ("gazelle.description.loader", "gazelle.doctor")


def main() -> None:
    """Measure everything."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--links", type=int, default=167)
    parser.add_argument("--runs", type=int, default=15)
    parser.add_argument("--peers", help="a Python with the peers in it")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.urdf")
        text = robot_text(options.links)
        path.write_text(text)
        base_ms = _best_ms(lambda: ET.fromstring(text), options.runs)
        _print(f"ElementTree, {text.count('<') - text.count('</')} elements", base_ms, base_ms)
        _measure_own(path, text, options, base_ms)
        _measure_peers(path, options.peers, base_ms)
    for module in _MODULES:
        _print(f"import {module}", _process_ms(["-c", f"import {module}"]), base_ms)


def robot_text(links: int, mesh: str = "") -> str:
    """Return a URDF with 22 elements per link.

    Args:
        links: how many.
        mesh: address of the mesh of every second link; boxes when empty.
    """
    lines = ['<?xml version="1.0"?>', '<robot name="large">']
    for number in range(links):
        is_mesh = mesh and number % 2
        shape = f'<mesh filename="{mesh}"/>' if is_mesh else '<box size="0.1 0.2 0.3"/>'
        place = '<origin xyz="0 0 0.1" rpy="0 0 0"/>'
        lines += [
            f'<link name="link_{number}">',
            f'  <inertial>{place}<mass value="1.5"/>',
            '    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>',
            f"  <visual>{place}<geometry>{shape}</geometry>",
            '    <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material></visual>',
            f"  <collision>{place}<geometry>{shape}</geometry></collision>",
            "</link>",
        ]
        if number:
            lines += [
                f'<joint name="joint_{number}" type="revolute">',
                f'  <parent link="link_{(number - 1) // 2}"/><child link="link_{number}"/>',
                '  <origin xyz="0.1 0 0.2" rpy="0 0 0.1"/><axis xyz="0 0 1"/>',
                '  <limit lower="-1.57" upper="1.57" effort="10" velocity="1"/>',
                '  <dynamics damping="0.1" friction="0.0"/>',
                "</joint>",
            ]
    return "\n".join([*lines, "</robot>"])


def _measure_own(path: Path, text: str, options: argparse.Namespace, base_ms: float) -> None:
    def load(file: Path) -> None:
        diagnostics = Diagnostics()
        assert load_models(file, workspace=None, diagnostics=diagnostics)

    parse_ms = _best_ms(lambda: parse_xml(text, "robot", Diagnostics()), options.runs)
    _print("parse_xml", parse_ms, base_ms)
    _print("load_models, boxes", _best_ms(lambda: load(path), options.runs), base_ms)
    mesh = path.with_name("mesh.stl")
    mesh.write_bytes(_stl(10_000))
    for title, address in (("meshes of 10,000 triangles", mesh), ("missing meshes", "none.stl")):
        path.write_text(robot_text(options.links, str(address)))
        _print(f"load_models, {title}", _best_ms(lambda: load(path), options.runs), base_ms)
    path.write_text(text)


def _measure_peers(path: Path, python: str | None, base_ms: float) -> None:
    if checker := shutil.which("check_urdf"):
        words = [checker, str(path)]
        run = lambda: subprocess.run(words, check=True, stdout=subprocess.DEVNULL)  # noqa: E731
        _print("check_urdf, a process", _best_ms(run, 5), base_ms)
    for name, setup in _PEERS.items() if python else ():
        words = [str(python), "-c", _PEER.format(setup=setup), str(path)]
        found = subprocess.run(words, check=True, capture_output=True, text=True).stdout
        _print(name, float(found), base_ms)


def _stl(triangles: int) -> bytes:
    corners = np.random.default_rng(0).random((triangles, 12)).astype("<f4")
    rows = np.zeros(triangles, [("numbers", "<f4", 12), ("attribute", "<u2")])
    rows["numbers"] = corners
    return b"\0" * 80 + triangles.to_bytes(4, "little") + rows.tobytes()


def _process_ms(words: list[str]) -> float:
    run = lambda: subprocess.run([sys.executable, *words], check=True)  # noqa: E731
    return _best_ms(run, 5)


def _best_ms(action: Callable[[], object], runs: int) -> float:
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times) * 1e3


def _print(title: str, best_ms: float, base_ms: float) -> None:
    row = {"what": title, "best_ms": round(best_ms, 2), "times_base": round(best_ms / base_ms, 1)}
    print(json.dumps(row), flush=True)


if __name__ == "__main__":
    main()
