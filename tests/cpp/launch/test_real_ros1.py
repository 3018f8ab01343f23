"""Nodes of C++ against real programs of ROS 1, where they are installed (Debian's packages)."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.bridge.conftest import eventually, graph  # noqa: F401 - fixtures
from tests.bridge.ros1.conftest import bridge, make_bridge  # noqa: F401 - fixtures
from tests.bridge.ros1.real import Ros1, skip_module_without_ros1
from tests.cpp.launch.conftest import Workspace, environment
from tests.cpp.launch.ros1_package import FILES
from tests.patience import stretched

from gazelle.bridge.ros1 import Bridge
from gazelle.graph import Graph

skip_module_without_ros1()
pytestmark = pytest.mark.reference
Eventually = Callable[[Callable[[], Any]], Any]

_GOOD = {name: text for name, text in FILES.items() if "bad" not in name and "falls" not in name}
_GOOD["answers/CMakeLists.txt"] = re.sub(
    r"\n[^\n]*\((?:bad|falls) [^\n]*", "", FILES["answers/CMakeLists.txt"]
)


def test_real_rostopic_asks_and_hears_a_node_of_cpp(
    graph: Graph,  # noqa: F811 - a fixture
    bridge: Bridge,  # noqa: F811 - a fixture
    workspace: Workspace,
    eventually: Eventually,  # noqa: F811 - a fixture
    tmp_path: Path,
) -> None:
    ros, top = Ros1(bridge.master.uri, tmp_path), workspace(_GOOD)
    words = [sys.executable, "-m", "gazelle.cli", "rosrun", "answers", "answerer"]
    with subprocess.Popen(
        words, cwd=top, env=environment(graph.port), stdout=subprocess.PIPE, text=True
    ) as node:
        assert node.stdout is not None
        assert "ready to answer" in node.stdout.readline()
        eventually(lambda: "/questions" in ros("rostopic", "list"))
        assert "Type: std_msgs/String" in ros("rostopic", "info", "/answers")
        ros("rostopic", "pub", "-1", "/questions", "std_msgs/String", "data: 'who'")
        # Latched: who comes late hears it, too.
        assert ros("rostopic", "echo", "-n", "1", "/answers") == 'data: "who!"\n---\n'
        node.send_signal(signal.SIGINT)
        assert node.wait(stretched()) == 0
