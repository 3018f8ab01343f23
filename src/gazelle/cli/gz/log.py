"""``gz log``: recording what a world's models do, and reading it.

The record is a bag of ``/gazebo/model_states`` and ``/gazebo/link_states``, where Gazebo writes a
``state.log`` of compressed XML. What is printed are ``<state>`` elements of SDF, as in Gazebo.

Source of the elements: http://sdformat.org/spec?elem=state.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Mapping
from datetime import datetime
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any, NamedTuple
from xml.sax.saxutils import quoteattr

from gazelle.bag import BagError, Encoding, bag_types, open_bag, ros1_name_of
from gazelle.bag.formats import ROS1
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number
from gazelle.cli.gz.world_link import WorldLink, pose_line, world_link
from gazelle.graph.gazebo_names import offered_name, world_names
from gazelle.interfaces import from_cdr, from_ros1
from gazelle.interfaces.poses import pose_of

__all__ = [
    "COMMAND",
    "LINK_STATES",
    "MODEL_STATES",
    "STATE_TOPICS",
    "run",
]

MODEL_STATES = "/gazebo/model_states"
LINK_STATES = "/gazebo/link_states"
STATE_TOPICS = (MODEL_STATES, LINK_STATES)
_NS = 1_000_000_000
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


class _Filter(NamedTuple):
    """Which models and links are shown, by names with ``*``."""

    model: str = "*"
    link: str = "*"

    @classmethod
    def read(cls, text: str) -> _Filter:
        """Read ``MODEL`` or ``MODEL/LINK``; nothing is everything.

        Raises:
            GzError: there is more behind it.
        """
        model, _, link = text.partition("/")
        if "/" in link:
            raise GzError(f"--filter is MODEL or MODEL/LINK, not '{text}'")
        return cls(model or "*", link or "*")


class _Body(NamedTuple):
    pose: str
    velocity: str


def _state_texts(file: str, wanted: _Filter, rate_hz: float = 0.0) -> Iterator[str]:
    """Give the states of a bag one after the other, lazily.

    Args:
        file: the bag.
        wanted: which models and links are shown.
        rate_hz: at most so many a second, all of them for 0.

    Raises:
        GzError: it is no bag, or has no states.
    """
    try:
        bag = open_bag(file)
    except BagError as error:
        raise GzError(str(error)) from None
    warn_of_unindexed(bag)
    types = bag_types(bag.connections).store
    topics = {one.topic for one in bag.connections}
    if topics.isdisjoint(world_names(MODEL_STATES)):
        raise GzError(f"there is no {MODEL_STATES} in '{file}'; gz log -d 1 records such bags")
    links: dict[str, _Body] = {}
    next_ns = 0
    wanted_topics = {name for topic in STATE_TOPICS for name in world_names(topic)}
    for one, stamp_ns, data in bag.messages(lambda item: item.topic in wanted_topics):
        read = from_ros1 if one.encoding is Encoding.ROS1 else from_cdr
        bodies = _bodies(read(types.ros1_message_type(ros1_name_of(one)), data))
        if one.topic in world_names(LINK_STATES):
            links = bodies
        elif stamp_ns >= next_ns:
            next_ns = stamp_ns + int(_NS / rate_hz) if rate_hz > 0 else 0
            yield _state(stamp_ns, bodies, links, wanted)
    bag.close()


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
    states = _state_texts(file, _Filter.read(options.get("filter", "")), number(options, "hz"))
    if "step" in options:
        _step(states)
    else:
        for text in states:
            print(text)
    return 0


def _bodies(message: Any) -> dict[str, _Body]:
    rows = zip(message.name, message.pose, message.twist, strict=True)
    return {name: _Body(_pose(pose), _velocity(twist)) for name, pose, twist in rows}


def _state(
    stamp_ns: int, models: Mapping[str, _Body], links: Mapping[str, _Body], wanted: _Filter
) -> str:
    seconds, rest_ns = divmod(stamp_ns, _NS)
    lines = ['<state world_name="default">', f"  <sim_time>{seconds} {rest_ns}</sim_time>"]
    for name, body in models.items():
        if fnmatchcase(name, wanted.model):
            lines += [f"  <model name={quoteattr(name)}>", f"    <pose>{body.pose}</pose>"]
            lines += _links(name, links, wanted)
            lines += ["  </model>"]
    return "\n".join([*lines, "</state>"])


def _links(model: str, links: Mapping[str, _Body], wanted: _Filter) -> Iterable[str]:
    for scoped, body in links.items():
        owner, _, name = scoped.rpartition("::")
        if owner == model and fnmatchcase(name, wanted.link):
            yield f"    <link name={quoteattr(name)}>"
            yield f"      <pose>{body.pose}</pose>"
            yield f"      <velocity>{body.velocity}</velocity>"
            yield "    </link>"


def _pose(message: Any) -> str:
    pose = pose_of(message)
    return pose_line((*pose.position_m, *pose.rpy_rad))


def _velocity(twist: Any) -> str:
    parts = (twist.linear, twist.angular)
    return pose_line(tuple(float(getattr(part, axis)) for part in parts for axis in "xyz"))


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
    command = ["rosbag", "record", "-O", str(path), f"__name:={_NODE[1:]}", "-q", *topics]
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli", *command],
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
            raise GzError(f"the recorder did not start; try gazelle {' '.join(command)}")
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
