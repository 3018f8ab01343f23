"""Nothing leaves the machine: a demo's sockets, from its start to its end, are all on 127.0.0.1."""

from __future__ import annotations

import ipaddress
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import psutil
import pytest

pytestmark = [
    pytest.mark.tutorial,
    pytest.mark.skipif(sys.platform != "linux", reason="other systems need root for this"),
]

_WORKSPACE = Path(__file__).parents[2] / "examples" / "scout_ws"


def test_demo_opens_no_socket_beyond_this_machine(
    gazelle: Callable[..., Any], free_port: int
) -> None:
    world = gazelle("roslaunch", "scout_robot", "scout.launch", cwd=_WORKSPACE)
    seen: set[str] = set()

    def looked(condition: bool) -> bool:
        seen.update(_addresses(world.processes()))
        return condition

    world.eventually(lambda: looked("finished cleanly" in world.text))
    world.messages({"/scan": 3, "/odom": 3})
    studio = gazelle("studio", "--port", "0", "--no-browser", port=free_port)
    world.eventually(lambda: looked("Studio: " in studio.text))
    echo = gazelle("rostopic", "echo", "-n", "3", "/odom", port=free_port)
    world.eventually(lambda: looked(echo.popen.poll() is not None))
    assert looked(studio.stop() == 0)
    assert looked(world.stop() == 0)
    assert seen
    beyond = {one for one in seen if not ipaddress.ip_address(one).is_loopback}
    assert beyond == set()


def _addresses(pids: dict[int, str]) -> Iterator[str]:
    """Yield both ends of all sockets of processes, where they have one."""
    for pid in pids:
        try:
            connections = psutil.Process(pid).net_connections("inet")
        except psutil.Error:
            continue
        for one in connections:
            yield from (end.ip for end in (one.laddr, one.raddr) if end)
    assert os.getpid() not in pids
