"""What a file is taken for."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.file_kinds import Kind, kind_of


@pytest.mark.parametrize(
    ("name", "text", "kind"),
    [
        ("bot_launch.py", "def generate_launch_description():\n    pass\n", Kind.LAUNCH_ROS2),
        ("test_bot_launch.py", "def generate_test_description():\n    pass\n", None),
        ("bot.launch.py", "print()\n", Kind.LAUNCH_ROS2),
        ("arm.srdf.xacro", "<robot name='arm'/>", Kind.SEMANTICS),
        ("arm.srdf", "<robot name='arm'/>", Kind.SEMANTICS),
        ("arm.urdf.xacro", "<robot name='arm'/>", Kind.ROBOT),
    ],
)
def test_kind_by_name_and_content(tmp_path: Path, name: str, text: str, kind: Kind | None) -> None:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    found = Diagnostics()
    assert (kind_of(path, found), list(found)) == (kind, [])
