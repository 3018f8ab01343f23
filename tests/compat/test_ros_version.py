"""Which generation's messages a module gets."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.launch.environment import drop_in_folder


@pytest.mark.parametrize(("build_type", "has_seq"), [("ament_python", "False"), ("catkin", "True")])
def test_installed_module_is_what_its_share_folder_says(
    tmp_path: Path, build_type: str, has_seq: str
) -> None:
    modules = tmp_path / "install/lib/python3.11/site-packages/my_package"
    modules.mkdir(parents=True)
    (modules / "__init__.py").write_text("")
    (modules / "part.py").write_text(
        "from std_msgs.msg import Header\nprint(hasattr(Header(), 'seq'))"
    )
    share = tmp_path / "install/share/my_package"
    share.mkdir(parents=True)
    (share / "package.xml").write_text(
        f"<package><name>my_package</name><export><build_type>{build_type}</build_type></export>"
        "</package>"
    )
    path = os.pathsep.join([str(drop_in_folder()), str(modules.parent)])
    environ = {"PATH": os.environ["PATH"], "PYTHONPATH": path, "HOME": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", "import my_package.part"],
        env=environ,
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=stretched(60),
        check=False,
    )
    assert done.stdout == f"{has_seq}\n", done.stderr
