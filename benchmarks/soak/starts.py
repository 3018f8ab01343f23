"""Starts robots again and again, beside busy loops or with Ctrl-C, and judges every start.

python benchmarks/soak/starts.py [--kind NAME …] [--runs N] [--busy N] [--interrupt 0.5,1,2,4,8]

Kinds: `ros1` (a ROS 1 robot with three controllers), `classic` (a ROS 2 robot in Gazebo Classic
with two spawners), `gz` (one in gz-sim, put there by `create -allow_renaming`, with two spawners),
`moveit` (an arm with its controllers and move_group). A start is right when the graph says that
every controller is active, the output and the logs hold no error, and everything ends on Ctrl-C.
With `--interrupt` the launch gets Ctrl-C that many seconds after its start, whatever it is doing;
right is then: no traceback, and nothing of it left after `--end` seconds.

Each start has a ROS_DOMAIN_ID and a ROS_HOME of its own. One line per start is printed and, as
JSON, appended to `--record`; a run that is started again goes on where the record of the same
commit ends.
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from marked_processes import commands_of, pids_of
from starts_packages import write_classic, write_gz

from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.interfaces import ros1_service_type, service_type

ROOT = Path(__file__).resolve().parents[2]
MARK = "GAZELLE_STARTS_RUN"
LIST = "controller_manager_msgs/ListControllers"
BAD = re.compile(
    r"Traceback \(|\[ERROR\]|\[FATAL\]|\bERROR:|\berror:|Exception|process has died|Fatal Python"
    r"|escalating to|failed to terminate"
)
BAD_AT_END = re.compile(
    r"Traceback \(|Exception ignored|Fatal Python|Segmentation|Aborted|panicked"
)
BUSY = "import os\nparent = os.getppid()\nwhile os.getppid() == parent: pass"


class Robot(NamedTuple):
    """A launch and what must be there when it is up.

    Attributes:
        words: the command.
        controllers: that must be active.
        is_ros2: which generation's services are asked.
        service: one more that must be offered.
    """

    words: tuple[str, ...]
    controllers: tuple[str, ...]
    is_ros2: bool = True
    service: str = ""


ROBOTS = {
    "ros1": Robot(
        ("roslaunch", "courier_robot", "courier.launch"),
        ("joint_state_controller", "diff_drive_controller", "head_controller"),
        is_ros2=False,
    ),
    "classic": Robot(
        ("ros2", "launch", "starling", "starling.launch.py"),
        ("joint_state_broadcaster", "drive_controller"),
    ),
    "gz": Robot(
        ("ros2", "launch", "wagtail", "wagtail.launch.py"),
        ("joint_state_broadcaster", "drive_controller"),
    ),
    "moveit": Robot(
        ("ros2", "launch", "heron_bringup", "heron.launch.py"),
        ("joint_state_broadcaster", "arm_controller", "hand_controller"),
        service="/plan_kinematic_path",
    ),
}


class Start(NamedTuple):
    """How a start went: `seconds` until it was up (or the signal), `end_s` from signal to end."""

    verdict: str
    seconds: float
    end_s: float
    reason: str


def main() -> int:
    """Start everything as often as is asked for and print a table."""
    options = _options()
    base = Path(tempfile.mkdtemp(prefix="gazelle-starts-"))
    folders = _workspaces(base)
    moments = [float(one) for one in options.interrupt.split(",") if one] or [0.0]
    commit = _commit()
    domains = itertools.cycle(range(options.domain, options.domain + 40))
    wanted = [
        (kind, moment, number)
        for number in range(options.runs)
        for kind in options.kind
        for moment in moments
    ]
    with _busy_loops(options.busy):
        for kind, moment, number in wanted:
            row = {"commit": commit, "kind": kind, "busy": options.busy, "interrupt_s": moment}
            if number < sum(_is_like(one, row) for one in _recorded(options.record)):
                continue
            robot, home = ROBOTS[kind], base / f"home-{kind}-{number}-{moment:g}"
            run = _Run(robot, folders[kind], next(domains), home)
            start = run.interrupted(moment, options) if moment else run.brought_up(options)
            with options.record.open("a", encoding="utf-8") as record:
                record.write(json.dumps({**row, **start._asdict()}) + "\n")
            print(f"{start.verdict:5} {kind:8}", end=" ")
            print(
                f"Ctrl-C at {moment:g} s" if moment else f"up after {start.seconds:5.1f} s", end=""
            )
            print(f", ended after {start.end_s:4.1f} s  {start.reason}", flush=True)
            if start.verdict == "right":
                shutil.rmtree(home, ignore_errors=True)
            else:
                print(f"      output: {home / 'output.txt'}", flush=True)
    return _print_table([one for one in _recorded(options.record) if one["commit"] == commit])


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    add = parser.add_argument
    add("--kind", nargs="+", choices=sorted(ROBOTS), default=list(ROBOTS))
    add("--runs", type=int, default=20, help="starts of each kind (and moment)")
    add("--busy", type=int, default=0, help="busy loops beside them")
    add("--interrupt", default="", help="seconds after the start, with commas: 0.5,1,2,4,8")
    add("--limit", type=float, default=240.0, help="seconds that a start may take")
    add("--end", type=float, default=5.0, help="seconds that the end may take, with --interrupt")
    add("--domain", type=int, default=150, help="first ROS_DOMAIN_ID of forty")
    add("--record", type=Path, default=Path("starts.jsonl"))
    return parser.parse_args()


class _Run:
    """One launch."""

    def __init__(self, robot: Robot, folder: Path, domain: int, home: Path) -> None:
        self._robot = robot
        self._folder = folder
        self._home = home
        self._mark = f"{os.getpid()}-{home.name}"
        self._environ = {
            **{key: value for key, value in os.environ.items() if key not in _GRAPH_WORDS},
            "ROS_DOMAIN_ID": str(domain),
            "ROS_HOME": str(home / "ros"),
            MARK: self._mark,
        }
        self._launch: subprocess.Popen[bytes] | None = None
        self._begun_s = 0.0

    def brought_up(self, options: argparse.Namespace) -> Start:
        """Start, wait until everything is there, end."""
        with self._running():
            missing = self._wait_until_up(options.limit)
            seconds = time.monotonic() - self._begun_s
            reason = missing or self._first(BAD)
            end_s = self._end(30.0)
        reason = reason or self._first(BAD_AT_END)
        reason = reason or ("something is left" if end_s >= 30.0 else "")
        return Start("wrong" if reason else "right", round(seconds, 1), end_s, reason)

    def interrupted(self, moment_s: float, options: argparse.Namespace) -> Start:
        """Start, give it Ctrl-C at a moment, and look at its end."""
        with self._running():
            time.sleep(max(0.0, self._begun_s + moment_s - time.monotonic()))
            end_s = self._end(options.end + 20.0)
            left = ", ".join(self._left())
        reason = self._first(BAD_AT_END) or (f"left: {left}" if left else "")
        if not reason and end_s > options.end:
            reason = f"took {end_s:.1f} s to end"
        return Start("wrong" if reason else "right", moment_s, end_s, reason)

    @contextlib.contextmanager
    def _running(self) -> Iterator[None]:
        self._home.mkdir(parents=True)
        words = [sys.executable, "-m", "gazelle.cli", *self._robot.words]
        with (self._home / "output.txt").open("wb") as output:
            self._begun_s = time.monotonic()
            self._launch = subprocess.Popen(
                words, env=self._environ, cwd=self._folder, start_new_session=True,
                stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
            )  # fmt: skip
            try:
                yield
            finally:
                for pid in self._pids():
                    with contextlib.suppress(ProcessLookupError):
                        os.kill(pid, signal.SIGKILL)
                self._launch.wait()

    def _wait_until_up(self, limit_s: float) -> str:
        """Return what is missing in the end, empty when all is there."""
        missing = "no graph"
        while time.monotonic() - self._begun_s < limit_s:
            assert self._launch is not None
            if self._launch.poll() is not None:
                return f"the launch has ended with {self._launch.returncode}; {missing}"
            try:
                with Graph.open(environ=self._environ, role="client") as graph:
                    missing = self._look(graph, limit_s)
            except GazelleError as error:
                missing = str(error).splitlines()[0]
            if not missing:
                return ""
            time.sleep(0.3)
        return missing

    def _look(self, graph: Graph, limit_s: float) -> str:
        """Ask again and again until all is there; return what is missing when it ends before."""
        node = graph.create_node("starts", anonymous=True, rosout=False)
        kind: Any = service_type(LIST) if self._robot.is_ros2 else ros1_service_type(LIST)
        make = kind.Request if self._robot.is_ros2 else kind._request_class
        good = "active" if self._robot.is_ros2 else "running"
        missing = ""
        while time.monotonic() - self._begun_s < limit_s and self._launch.poll() is None:
            client = node.create_client("/controller_manager/list_controllers", kind)
            try:
                states = client.call(make(), timeout_s=10.0).controller
            except GazelleError as error:
                missing = str(error).splitlines()[0]
            else:
                states = {one.name: one.state for one in states}
                missing = ", ".join(
                    f"{one} is {states.get(one, 'not there')}"
                    for one in self._robot.controllers
                    if states.get(one) != good
                )
                service = self._robot.service
                if not missing and service and not graph.has_service(service):
                    missing = f"no {service}"
            finally:
                client.unregister()
            if not missing:
                return ""
            time.sleep(0.5)
        return missing

    def _end(self, limit_s: float) -> float:
        """Send Ctrl-C as a terminal does; return the seconds until nothing is left."""
        assert self._launch is not None
        begun_s = time.monotonic()
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._launch.pid, signal.SIGINT)
        while time.monotonic() - begun_s < limit_s:
            self._launch.poll()
            if not self._pids():
                break
            time.sleep(0.05)
        return round(time.monotonic() - begun_s, 1)

    def _pids(self) -> list[int]:
        return pids_of(MARK, self._mark)

    def _left(self) -> list[str]:
        return commands_of(self._pids())

    def _first(self, pattern: re.Pattern[str]) -> str:
        """Return the first line of the output or of a log that matches."""
        for path in [self._home / "output.txt", *sorted((self._home / "ros").rglob("*.log"))]:
            for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
                if pattern.search(line):
                    return f"{path.name}: {line.strip()[:160]}"
        return ""


_GRAPH_WORDS = frozenset({"ROS_MASTER_URI", "GAZELLE_PORT", "ROS_NAMESPACE", "ROS_PACKAGE_PATH"})


def _workspaces(base: Path) -> dict[str, Path]:
    return {
        "ros1": ROOT / "examples" / "four_wheel_ws",
        "moveit": ROOT / "examples" / "arm_ws",
        "classic": write_classic(base / "classic_ws"),
        "gz": write_gz(base / "gz_ws"),
    }


@contextlib.contextmanager
def _busy_loops(number: int) -> Iterator[None]:
    loops = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(number)]
    try:
        yield
    finally:
        for one in loops:
            one.kill()
            one.wait()


def _commit() -> str:
    def git(*words: str) -> str:
        done = subprocess.run(
            ["git", *words], check=False, cwd=ROOT, capture_output=True, text=True
        )
        return done.stdout.strip()

    return git("rev-parse", "--short", "HEAD") + (
        "+" if git("status", "--porcelain", "src") else ""
    )


def _recorded(path: Path) -> list[dict[str, Any]]:
    if not path.is_file():
        return []
    return [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]


def _is_like(one: dict[str, Any], row: dict[str, Any]) -> bool:
    return all(one[key] == value for key, value in row.items())


def _print_table(rows: Sequence[dict[str, Any]]) -> int:
    groups: dict[tuple[str, int, float], list[dict[str, Any]]] = {}
    for row in rows:
        groups.setdefault((row["kind"], row["busy"], row["interrupt_s"]), []).append(row)
    print("\nkind      busy  Ctrl-C  right     up (median, worst)  end (worst)  wrong")
    for (kind, busy, moment), group in sorted(groups.items()):
        right = sum(one["verdict"] == "right" for one in group)
        up = sorted(one["seconds"] for one in group)
        wrong = Counter(one["reason"] for one in group if one["reason"])
        reasons = "; ".join(f"{count}x {text}" for text, count in wrong.items())
        print(
            f"{kind:9} {busy:4}  {moment or '-':>6}  {right:2} of {len(group):2}  "
            f"{up[len(up) // 2]:8.1f} s {up[-1]:6.1f} s  "
            f"{max(one['end_s'] for one in group):8.1f} s  {reasons}"
        )
    return 0 if all(one["verdict"] == "right" for one in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
