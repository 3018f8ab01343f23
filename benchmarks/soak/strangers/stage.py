"""A stage for public packages: launches and commands on a graph of their own, and what is seen.

Everything runs as a person would run it, through the installed command `gazelle` in the folder of
the package; only the graph is private, so that several run on one machine.
"""

from __future__ import annotations

import contextlib
import math
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple
from xml.etree import ElementTree

from marked_processes import commands_of, pids_of

from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.graph.isolated_graph import open_graph
from gazelle.graph.tf import TransformBuffer, TransformListener
from gazelle.interfaces import action_type, fill
from gazelle.testing.launch import Launch
from gazelle.testing.messages import Waiting
from gazelle.testing.process_tree import ProcessTree, launch_environment

END_S = 5.0
"""All processes of a launch are gone this long after Ctrl-C, in seconds of real time."""

_MARK = "GAZELLE_STRANGER"


class Finished(NamedTuple):
    """How a command ended: its exit code, and stdout and stderr as they came, together."""

    code: int
    output: str
    stdout: str


class RobotParts(NamedTuple):
    """What is in a URDF.

    Attributes:
        links: their names.
        joints: the names of joints of robots (those of transmissions are not counted).
        kinds: how many joints of each type there are.
        mass_kg: of all links together.
        root: the link without a parent.
    """

    links: list[str]
    joints: list[str]
    kinds: Counter[str]
    mass_kg: float
    root: str

    @property
    def moving(self) -> int:
        """How many joints are not fixed."""
        return self.kinds.total() - self.kinds["fixed"]


def robot_parts(urdf: str) -> RobotParts:
    """Count what is in the text of a URDF, as `xacro` prints it."""
    robot = ElementTree.fromstring(urdf)
    links = [str(link.get("name")) for link in robot.findall("link")]
    joints = robot.findall("joint")
    children = {str(child.get("link")) for joint in joints for child in joint.findall("child")}
    masses = robot.findall("link/inertial/mass")
    return RobotParts(
        links,
        [str(joint.get("name")) for joint in joints],
        Counter(str(joint.get("type")) for joint in joints),
        sum(float(str(mass.get("value"))) for mass in masses),
        next(link for link in links if link not in children),
    )


class Stage:
    """The folder of one public package, with one graph for all that is started in it.

    Attributes:
        folder: where commands run.
        graph: the graph they are on.
        home: the home folder of what is started, empty at first.
    """

    def __init__(self, folder: Path, environment: Mapping[str, str], timeout_s: float) -> None:
        """Open it; use `staged`."""
        self.folder = folder
        self.graph: Graph = open_graph()
        self.home = Path(tempfile.mkdtemp(prefix="gazelle-stranger-"))
        self._launches = 0
        self._timeout_s = timeout_s
        variables = {
            "ROS_PACKAGE_PATH": str(folder / "ws" / "src"),
            # As in an activated virtual environment.
            "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")]),
        }
        if (folder / "gazebo_models").is_dir():
            variables["GAZEBO_MODEL_PATH"] = str(folder / "gazebo_models")
        self.environment = launch_environment(
            self.graph.port, self.home, {**variables, **environment}
        )

    def run(
        self,
        command: str,
        *,
        stdin: str = "",
        timeout_s: float = 120.0,
        env: Mapping[str, str] | None = None,
        cwd: str = ".",
        traceback: bool = False,
    ) -> Finished:
        """Run a command of ROS or Gazebo to its end: ``rostopic list``, ``xacro robot.xacro``.

        One that does not end by itself within `timeout_s` gets Ctrl-C, and then counts by its code.
        ``shell COMMAND`` runs any other program where ROS's commands and modules are.

        Args:
            command: as it is typed.
            stdin: what it reads.
            timeout_s: patience in seconds of real time.
            env: more environment variables.
            cwd: where it runs, in the package's folder.
            traceback: the package's own code is known to print one.
        """
        popen = subprocess.Popen(
            [sys.executable, "-m", "gazelle.cli", *shlex.split(command)],
            cwd=self.folder / cwd, env={**self.environment, **(env or {})}, text=True,
            errors="replace", stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            start_new_session=True,
        )  # fmt: skip
        try:
            out, err = popen.communicate(stdin, timeout=timeout_s)
        except subprocess.TimeoutExpired:
            os.killpg(popen.pid, signal.SIGINT)
            out, err = popen.communicate(timeout=30.0)
        assert traceback or "Traceback (most recent call last)" not in err, err
        return Finished(popen.returncode, out + err, out)

    def robot(self, command: str, env: Mapping[str, str] | None = None) -> RobotParts:
        """Count what a file and its arguments expand to: ``ws/src/pkg/robot.xacro laser:=true``."""
        done = self.run(f"xacro {command}", env=env)
        assert done.code == 0, done.output
        return robot_parts(done.stdout)

    @contextlib.contextmanager
    def launch(
        self, command: str, *, env: Mapping[str, str] | None = None, traceback: bool = False
    ) -> Iterator[Seen]:
        """Run a launch for the time of a ``with`` block, and look at its end.

        Args:
            command: as it is typed: ``roslaunch pkg file.launch x:=1``, ``gz sim -r world.sdf``.
            env: more environment variables.
            traceback: the package's own code is known to end with one.
        """
        waiting = Waiting(self._timeout_s)
        self._launches += 1
        mark = f"{os.getpid()}-{self.home.name}-{self._launches}"
        tree = ProcessTree(
            shlex.split(command), cwd=self.folder,
            on_change=waiting.wake,
            environment={**self.environment, **(env or {}), _MARK: mark},
        )  # fmt: skip
        waiting.ended = tree.ended
        seen = Seen(tree, self.graph, waiting)
        try:
            yield seen
            begun_s = time.monotonic()
            seen.interrupt()
            while _left(mark) and time.monotonic() - begun_s < END_S + 15.0:
                time.sleep(0.05)
            took_s = time.monotonic() - begun_s
            assert took_s <= END_S, f"took {took_s:.1f} s to end, left: {_left(mark)}"
            if not traceback:
                assert "Traceback (most recent call last)" not in seen.output, seen.output
        except BaseException:
            print(seen.output, file=sys.stderr)
            raise
        finally:
            seen.close()
            for pid in _pids(mark):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)

    def place(self, model: str) -> tuple[float, ...]:
        """Return x, y, z, roll, pitch and yaw of a model of the running world."""
        asked = self.run(f"gz model -m {model} -p")
        assert asked.code == 0, asked.output
        # gz sim's way has brackets around each three.
        return tuple(float(one) for one in re.sub(r"[\[\]]", " ", asked.stdout).split()[-6:])

    def close(self) -> None:
        """Leave the graph."""
        self.graph.close()


class Seen(Launch):
    """A launch that runs, with what these packages are measured by."""

    _tf: TransformListener | None = None

    def interrupt(self) -> None:
        """Give it Ctrl-C as a terminal does: to all of its processes."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._tree.pid, signal.SIGINT)

    def rate_hz(self, topic: str, sim_s: float = 3.0) -> float:
        """Return how often a topic comes in a second of simulated time.

        By the messages' stamps; by ``/clock`` where they have none.
        """
        messages = self.topic(topic)
        stamps = [self._stamp_s(messages.next())]
        while stamps[-1] - stamps[0] < sim_s or len(stamps) < 3:
            stamps.append(self._stamp_s(messages.next()))
        messages.close()
        return (len(stamps) - 1) / (stamps[-1] - stamps[0])

    def has_rate(self, topic: str, hz: float, sim_s: float = 3.0, share: float = 0.1) -> None:
        """Check a rate within a share of it."""
        rate = self.rate_hz(topic, sim_s)
        assert abs(rate - hz) <= share * hz, f"{topic}: {rate:.2f} Hz, expected {hz:g}"

    def camera_has_rate(self, topic: str, hz: float) -> None:
        """Check the rate of a camera; one that drops frames, as on a slow machine, must say so."""
        try:
            self.has_rate(topic, hz, sim_s=2.0)
        except AssertionError:
            if not self.said(rf"late for its {hz:g} Hz: frames are dropped"):
                raise

    def topics(self) -> set[str]:
        """Return the names of all topics that are published or listened to."""
        return {one.name for one in self.graph.topics()}

    def wait_for_topics(self, *names: str) -> None:
        """Wait until all of these are there."""
        self._waiting.until(
            lambda: set(names) <= self.topics(), f"topics {', '.join(names)}", None,
            hint=lambda: f"there: {', '.join(sorted(self.topics()))}",
        )  # fmt: skip

    def run_sim(self, seconds: float, timeout_s: float | None = None) -> None:
        """Let so many more seconds be simulated."""
        self.wait_until(0.001, timeout_s)
        self.wait_until(self.sim_time_s + seconds, timeout_s or 60.0 + 10.0 * seconds)

    def says(self, pattern: str, timeout_s: float | None = None) -> str:
        """Wait for a line of the output."""
        return self.wait_for_line(pattern, timeout_s)

    def said(self, pattern: str) -> list[str]:
        """Return the lines so far that match."""
        return [line for line in self.output.splitlines() if re.search(pattern, line)]

    def joints(self, topic: str = "/joint_states") -> dict[str, float]:
        """Return the positions of the joints by name, of the next message."""
        message = self.topic(topic).next()
        return dict(zip(message.name, message.position, strict=False))

    def reach_goal(
        self, action: str, type_name: str, timeout_s: float = 60.0, /, **fields: Any
    ) -> ClientGoal:
        """Send a goal to an action server, as soon as it is there, and wait until it is over."""
        client = ActionClient(self.node, action, type_name)
        client.require_server(timeout_s)
        goal = action_type(type_name).Goal()
        fill(goal, fields)
        sent = client.send_goal(goal)
        assert sent.wait(timeout_s), f"{action}: not over after {timeout_s:g} s"
        return sent

    def tf(self, target: str, source: str, timeout_s: float = 60.0) -> Pose:
        """Return ``T_target_source``, as soon as there is a way from one to the other."""
        if self._tf is None:
            self._tf = TransformListener(TransformBuffer(), self.node)
        return self._tf.buffer.lookup_transform(target, source, timeout_s=timeout_s).pose

    def joint_reaches(
        self, name: str, position: float, tolerance: float, topic: str = "/joint_states"
    ) -> None:
        """Wait until a joint is at a position (rad or m)."""

        def is_there(message: Any) -> bool:
            at = dict(zip(message.name, message.position, strict=False))
            return name in at and abs(at[name] - position) <= tolerance

        self.topic(topic).wait_for(is_there)

    def drive(
        self, topic: str, linear: float, angular: float, sim_s: float, *, stamped: bool = False
    ) -> None:
        """Command a speed at 10 Hz of simulated time, as a ``Twist`` or a ``TwistStamped``."""
        kind = f"geometry_msgs/msg/Twist{'Stamped' if stamped else ''}"
        twist = {"linear": {"x": linear}, "angular": {"z": angular}}
        self.wait_until(0.001)
        end_s = self.sim_time_s + sim_s
        while self.sim_time_s < end_s:
            now_s = self.sim_time_s
            stamp = {"sec": int(now_s), "nanosec": int(now_s % 1.0 * 1e9)}
            fields = {"header": {"stamp": stamp}, "twist": twist} if stamped else twist
            self.publish(topic, kind, **fields)
            self.wait_until(now_s + 0.1)

    def controllers(self, manager: str = "/controller_manager") -> dict[str, str]:
        """Return the states of the controllers of ros2_control by name."""
        answer = self.call(f"{manager}/list_controllers")
        return {one.name: one.state for one in answer.controller}

    def wait_for_controllers(
        self, *names: str, manager: str = "/controller_manager", state: str = "active"
    ) -> None:
        """Wait until all of these are in a state."""
        deadline_s = time.monotonic() + self._waiting.timeout_s
        while True:
            there = self.controllers(manager)
            if all(there.get(name) == state for name in names):
                return
            assert time.monotonic() < deadline_s, f"not all {state}: {there}"
            time.sleep(0.5)

    def true_pose(self, model: str, topic: str = "/gazebo/model_states") -> Any:
        """Return where the simulator says a model is, once it is there."""
        heard = self.topic(topic)
        states = heard.wait_for(lambda message: model in message.name)
        # It comes with every step, and would fill the memory.
        heard.close()
        return states.pose[states.name.index(model)]

    def frames(self, sim_s: float = 1.0) -> dict[str, str]:
        """Return the frames of tf with their parents, as heard for so long."""
        parents: dict[str, str] = {}

        def take(message: Any) -> None:
            parents.update((one.child_frame_id, one.header.frame_id) for one in message.transforms)

        listening = [
            self.node.create_subscription(name, "tf2_msgs/msg/TFMessage", take, queue_size=0)
            for name in ("/tf", "/tf_static")
        ]
        self.run_sim(sim_s)
        for one in listening:
            one.unregister()
        return parents

    def _stamp_s(self, message: Any) -> float:
        header = getattr(message, "header", None)
        if header is None:
            return self.sim_time_s
        return float(header.stamp.sec + header.stamp.nanosec * 1e-9)


def yaw_rad(quat: Any) -> float:
    """Return the heading of a ``geometry_msgs/Quaternion``."""
    return math.atan2(
        2.0 * (quat.w * quat.z + quat.x * quat.y), 1.0 - 2.0 * (quat.y**2 + quat.z**2)
    )


def roll_pitch_rad(quat: Any) -> tuple[float, float]:
    """Return roll and pitch of a ``geometry_msgs/Quaternion``."""
    roll = math.atan2(
        2.0 * (quat.w * quat.x + quat.y * quat.z), 1.0 - 2.0 * (quat.x**2 + quat.y**2)
    )
    return roll, math.asin(max(-1.0, min(1.0, 2.0 * (quat.w * quat.y - quat.z * quat.x))))


def _pids(mark: str) -> list[int]:
    return pids_of(_MARK, mark)


def _left(mark: str) -> str:
    return "; ".join(commands_of(_pids(mark)))


@contextlib.contextmanager
def staged(
    folder: Path, environment: Mapping[str, str] | None = None, timeout_s: float = 90.0
) -> Iterator[Stage]:
    """Open the stage of one package for the time of a ``with`` block."""
    stage = Stage(folder, environment or {}, timeout_s)
    try:
        yield stage
    finally:
        stage.close()
