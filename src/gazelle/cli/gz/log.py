"""``gz log``: recording what a world's models do, and reading it.

The record is a bag of ``/gazebo/model_states`` and ``/gazebo/link_states``, where Gazebo writes a
``state.log`` of compressed XML. What is printed are ``<state>`` elements of SDF, as in Gazebo.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from datetime import datetime
from pathlib import Path

from gazelle.bag.formats import ROS1
from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number
from gazelle.cli.gz.states import MODEL_STATES, STATE_TOPICS, Filter, state_texts
from gazelle.cli.gz.world_link import WorldLink, world_link
from gazelle.graph.gazebo_names import offered_name

__all__ = ["COMMAND", "run"]

COMMAND = GzCommand(
    "log",
    "Record the state of a running world into a bag, or read such a bag.",
    (
        GzOption("world-name", "w", "World name; Gazelle has one world.", takes=True),
        GzOption("record", "d", "1: start to record, 0: stop.", takes=True),
        GzOption("file", "f", "The bag to read, or to record into.", takes=True),
        GzOption("info", "i", "Output information about the bag."),
        GzOption("echo", "e", "Output the states in the bag, as <state> of SDF."),
        GzOption("step", "s", "The same, one by one: Enter goes on, q ends."),
        GzOption("hz", "z", "At most so many states a second of simulated time.", takes=True),
        GzOption("filter", "", "MODEL or MODEL/LINK; * stands for any letters.", takes=True),
    ),
)
_NODE = "/gz_log"
_START_S = 10.0
_END_S = 30.0
_PAUSE_S = 0.02
_HEAD_BYTES = 200


def run(options: Mapping[str, str]) -> int:
    """Start or stop recording, or read a bag.

    Raises:
        GzError: an option is wrong, there is no world, or it is no bag.
    """
    word = options.get("record")
    if word is not None:
        if word not in ("0", "1"):
            raise GzError(f"--record is 0 or 1, not '{word}'")
        with world_link() as link:
            if word == "1":
                _start(link, options.get("file", ""))
            else:
                _stop(link)
        return 0
    if not {"info", "echo", "step"} & options.keys():
        raise GzError("nothing to do; see gz help log")
    file = _existing(options.get("file", ""))
    if "info" in options:
        from gazelle.cli.rosbag.info import run as rosbag_info

        return rosbag_info([file])
    states = state_texts(file, Filter.read(options.get("filter", "")), number(options, "hz"))
    if "step" in options:
        _step(states)
    else:
        for text in states:
            print(text)
    return 0


def _existing(word: str) -> str:
    if not word:
        raise GzError("-f FILE names the bag; gz log -d 1 says which one it records")
    if _is_state_log(Path(word)):
        raise GzError(f"'{word}' is a state.log of Gazebo, which only Gazebo's gz log reads")
    return word


def _is_state_log(path: Path) -> bool:
    if not path.is_file():
        return False
    with path.open("rb") as file:
        return file.read(_HEAD_BYTES).lstrip().startswith((b"<?xml", b"<gazebo_log"))


def _start(link: WorldLink, word: str) -> None:
    if _NODE in link.graph.node_names():
        raise GzError("a recorder runs already; gz log -d 0 stops it")
    if not link.graph.publisher_count(offered_name(link.graph, MODEL_STATES)):
        # The first answer of a new member may come before all of the graph is known.
        link.call("get_world_properties", "gazebo_msgs/GetWorldProperties")
    path = Path(word).absolute() if word else _default_path()
    path = path if path.suffix == ROS1.suffix else path.with_name(path.name + ROS1.suffix)
    path.parent.mkdir(parents=True, exist_ok=True)
    topics = [offered_name(link.graph, topic) for topic in STATE_TOPICS]
    words = ["rosbag", "record", "-O", str(path), f"__name:={_NODE[1:]}", "-q", *topics]
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli", *words],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        # It stays when this command and its shell have ended.
        start_new_session=True,
        env={**os.environ, "ROS_NAMESPACE": "/"},
    )
    end_s = time.monotonic() + _START_S
    states = offered_name(link.graph, MODEL_STATES)
    while _NODE not in {one.node for one in link.graph.subscriptions_info(states)}:
        if process.poll() is not None or time.monotonic() > end_s:
            raise GzError(f"the recorder did not start; try gazelle {' '.join(words)}")
        link.ended.wait(_PAUSE_S)
    print(f"recording to {path}; gz log -d 0 stops it")


def _default_path() -> Path:
    """Gazebo's folder: one for each record, named by its time."""
    now = datetime.now().astimezone().strftime("%Y-%m-%dT%H:%M:%S.%f")
    return Path.home() / ".gazebo" / "log" / now.replace(":", "") / "gzserver" / "state.bag"


def _stop(link: WorldLink) -> None:
    if _NODE not in link.graph.node_names():
        raise GzError("no recorder runs; gz log -d 1 starts one")
    pid = link.graph.node_info(_NODE).pid
    link.graph.kill_node(_NODE)
    end_s = time.monotonic() + _END_S
    # Its node leaves the graph first; the bag is whole when the process has ended.
    while _NODE in link.graph.node_names() or _runs(pid):
        if time.monotonic() > end_s:
            raise GzError(f"the recorder does not end; try rosnode kill {_NODE}")
        link.ended.wait(_PAUSE_S)


def _runs(pid: int) -> bool:
    # Windows has no signal that only asks; there the node's leaving has to do.
    if not pid or not hasattr(os, "WNOHANG"):
        return False
    try:
        # For who started it in this very process: a child stays until it is asked for.
        with contextlib.suppress(ChildProcessError):
            os.waitpid(pid, os.WNOHANG)
        os.kill(pid, 0)
    except (ProcessLookupError, PermissionError):
        return False
    return True


def _step(states: Iterator[str]) -> None:
    for text in states:
        print(text)
        try:
            if input("--- Enter to continue, q to quit --- ").strip() == "q":
                return
        except EOFError:
            return
