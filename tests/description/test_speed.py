"""Reading stays quick, measured against Python's own XML parser on the same machine."""

from __future__ import annotations

import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics

_LINK = """<link name="link_{n}">
  <inertial><origin xyz="0 0 0.1" rpy="0 0 0"/><mass value="1.5"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  <visual><origin xyz="0 0 0.1"/><geometry><box size="0.1 0.2 0.3"/></geometry></visual>
  <collision><origin xyz="0 0 0.1"/><geometry><box size="0.1 0.2 0.3"/></geometry></collision>
</link>
"""
_JOINT = """<joint name="joint_{n}" type="revolute">
  <parent link="link_{parent}"/><child link="link_{n}"/><origin xyz="0.1 0 0.2" rpy="0 0 0.1"/>
  <axis xyz="0 0 1"/><limit lower="-1.57" upper="1.57" effort="10" velocity="1"/>
</joint>
"""


def _least_s(action: Callable[[], object], runs: int) -> float:
    times = []
    for _ in range(runs):
        start_s = time.thread_time()
        action()
        times.append(time.thread_time() - start_s)
    return min(times)


def test_robot_of_3500_elements_takes_as_long_as_30_bare_parses(tmp_path: Path) -> None:
    joints = [_JOINT.format(n=number, parent=(number - 1) // 2) for number in range(1, 200)]
    links = [_LINK.format(n=number) for number in range(200)]
    path = tmp_path / "robot.urdf"
    path.write_text(f'<robot name="r">{"".join([*links, *joints])}</robot>')
    text = path.read_text()
    assert text.count("<") - text.count("</") > 3500

    def load() -> None:
        assert len(load_models(path, workspace=None, diagnostics=Diagnostics())[0].links) == 200

    # 14 times as long where it was written: 45 ms.
    assert _least_s(load, 7) < 30 * _least_s(lambda: ET.fromstring(text), 15)


def test_reading_a_plain_file_brings_no_module_that_only_xacro_needs() -> None:
    names = ("collada", "scipy", "xacro", "xml.dom.minidom", "yaml")
    code = (
        f"import gazelle.description.loader, sys; print([n for n in {names} if n in sys.modules])"
    )
    words = [sys.executable, "-c", code]
    found = subprocess.run(words, capture_output=True, text=True, check=True, timeout=60)
    assert found.stdout == "[]\n"
