"""A package with one small script that does what its arguments say."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

_SCRIPT = '''#!/usr/bin/env python3
"""Does what its arguments say, one after another."""
import os, signal, subprocess, sys, threading

STUBBORN = "import signal, threading; [signal.signal(n, signal.SIG_IGN) for n in (2, 15)]"


def tell(*words, to=1):
    # In one piece: print writes word by word where output is not buffered, and others write too.
    os.write(to, (" ".join(map(str, words)) + "\\n").encode())


for word in sys.argv[1:]:
    name, _, value = word.partition("=")
    if name == "say":
        tell(value)
    elif name == "complain":
        tell(value, to=2)
    elif name == "env":
        tell(value, "is", os.environ.get(value))
    elif name == "cwd":
        tell("cwd is", os.getcwd())
    elif name == "ignore":
        signal.signal(getattr(signal, value), signal.SIG_IGN)
    elif name == "child":
        code = STUBBORN + "; print('child is there', flush=True); threading.Event().wait(60)"
        subprocess.Popen([sys.executable, "-c", code])
    elif name == "node":
        import rospy
        rospy.init_node(value)
        rospy.spin()
    elif name == "wait":
        threading.Event().wait(60)
    elif name == "exit":
        sys.exit(int(value))
'''


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package ``tests_pkg`` with the executable ``does``."""
    return write_package(tmp_path)


def write_package(workspace: Path) -> Path:
    """Write the package into a workspace; return its folder."""
    folder = workspace / "src" / "tests_pkg"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package><name>tests_pkg</name><version>1.0.0</version>"
        "<description>d</description><maintainer email='a@b.c'>m</maintainer>"
        "<license>BSD</license></package>",
        encoding="utf-8",
    )
    script = folder / "scripts" / "does"
    script.write_text(_SCRIPT, encoding="utf-8")
    script.chmod(0o755)
    return folder


@pytest.fixture
def launch(gazelle: Callable, package: Path, tmp_path: Path) -> Callable:
    """Launches the body of a launch file."""

    def run(body: str, *options: str, **environ: str) -> object:
        file = tmp_path / "test.launch"
        file.write_text(f"<launch>{body}</launch>", encoding="utf-8")
        return gazelle("roslaunch", *options, str(file), **environ)

    return run


def node(name: str, args: str = "", **attributes: str) -> str:
    """Return a ``<node>`` that runs the script."""
    more = " ".join(f'{key.replace("_", "-")}="{value}"' for key, value in attributes.items())
    return f'<node pkg="tests_pkg" type="does" name="{name}" args="{args}" {more}/>'


@pytest.fixture(name="node")
def node_fixture() -> Callable[..., str]:
    """Writes a ``<node>`` that runs the script."""
    return node
