"""Runs pytest over a small package, as its user does."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import entry_points
from pathlib import Path

import pytest
from tests.patience import stretched

_MODULE = "gazelle.testing.plugin"
_SPEAKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String
from std_srvs.srv import SetBool, SetBoolResponse

rospy.init_node("speaker")
publisher = rospy.Publisher("/words", String, queue_size=10, latch=True)
rospy.Subscriber("/echo", String, lambda m: publisher.publish(m.data + rospy.get_param("~end")))
rospy.Service("/answer", SetBool, lambda q: SetBoolResponse(q.data, "heard"))
print("the speaker is ready", flush=True)
rospy.spin()
"""
_LAUNCH = """<launch>
  <arg name="end" default="!"/>
  <node pkg="speech" type="speaker.py" name="speaker" output="screen">
    <param name="end" value="$(arg end)"/>
  </node>
</launch>
"""
_MANIFEST = (
    "<package><name>speech</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.c'>m</maintainer><license>BSD</license></package>"
)
Pytest = Callable[..., subprocess.CompletedProcess[str]]


def plugin_words() -> list[str]:
    """Return the options that load the plug-in where the installed entry points lack it."""
    known = {one.value for one in entry_points(group="pytest11")}
    return [] if _MODULE in known else ["-p", _MODULE]


def run_pytest(folder: Path, *words: str, **environ: str) -> subprocess.CompletedProcess[str]:
    """Run pytest in a folder; return what it printed."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "PYTEST_"))}
    return subprocess.run(
        [sys.executable, "-m", "pytest", *plugin_words(), "-p", "no:cacheprovider",
         "-c", os.devnull, "--rootdir", str(folder), "-q", *words],
        cwd=folder, env={**kept, **environ}, text=True, check=False, timeout=stretched(240),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip


@pytest.fixture
def speech_tests(tmp_path: Path) -> Pytest:
    """Runs a test file of the package ``speech``, whose node says what it hears."""
    package = tmp_path / "src" / "speech"
    for name, text in (
        ("package.xml", _MANIFEST),
        ("scripts/speaker.py", _SPEAKER),
        ("launch/speech.launch", _LAUNCH),
    ):
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    (package / "scripts" / "speaker.py").chmod(0o755)

    def run(body: str, *words: str, **environ: str) -> subprocess.CompletedProcess[str]:
        (package / "test").mkdir()
        file = package / "test" / "test_it.py"
        file.write_text(f"import pytest\n{body}", encoding="utf-8")
        return run_pytest(tmp_path, *words, str(file), **environ)

    return run
