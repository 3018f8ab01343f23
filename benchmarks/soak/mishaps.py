"""What happens to a robot that runs when something happens to its processes, clock, disk or hub?

    python benchmarks/soak/mishaps.py [--stop-s S] [NAME…]

The example robot runs in its workshop, in real time, on a graph whose hub is a `roscore` of its
own. Then, one after the other:

* ``simulator-stopped``, ``node-stopped``, ``launcher-stopped``: SIGSTOP for 20 s.
* ``clock-set-back``: an hour, for all processes of the launch; needs a C compiler (``cc``).
* ``disk-full``: a recorder and the launch's logs reach a file size's limit.
* ``folder-removed``: of the logs and of a bag that is being recorded.
* ``hub-unplugged``: SIGKILL for `roscore`.

After each the robot must drive when it is told to and `rostopic list` must answer; what is to be
said must stand in the log. Prints a JSON object per mishap; exit code 1 when one is not withstood.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import psutil
from launched_scout import LaunchedScout, launched_scout
from marked_processes import pids_of

from gazelle.bag import open_bag
from gazelle.graph import Graph, NoGraphError
from gazelle.interfaces import message_type

_MARK = "GAZELLE_MISHAPS"
_SHIFT = "clock_shift"
# Adds what a file says to the system's clock; libfaketime 0.9.10 breaks clock_nanosleep.
_SHIFTED_CLOCK = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>
static volatile long *shift;
__attribute__((constructor)) static void begin(void) {
    int file = open(getenv("CLOCK_SHIFT"), O_RDONLY);
    void *place = mmap(0, sizeof(long), PROT_READ, MAP_SHARED, file, 0);
    if (place != MAP_FAILED) shift = place;
}
int clock_gettime(clockid_t id, struct timespec *at) {
    static int (*real)(clockid_t, struct timespec *);
    if (!real) real = dlsym(RTLD_NEXT, "clock_gettime");
    int code = real(id, at);
    if (!code && shift && (id == CLOCK_REALTIME || id == CLOCK_REALTIME_COARSE))
        at->tv_sec += *shift;
    return code;
}
int gettimeofday(struct timeval *restrict at, void *restrict zone) {
    struct timespec now;
    (void)zone;
    clock_gettime(CLOCK_REALTIME, &now);
    at->tv_sec = now.tv_sec;
    at->tv_usec = now.tv_nsec / 1000;
    return 0;
}
time_t time(time_t *at) {
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (at) *at = now.tv_sec;
    return now.tv_sec;
}
"""
_PATIENCE_S = 60.0
_DRIVEN_M = 0.1
_FILE_BYTES = 300_000


def main() -> int:
    """Run, print, judge."""
    options = _options()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with (
            _hub(folder) as (port, core),
            launched_scout(folder, _MARK, GAZELLE_PORT=port, **_shifted_clock(folder)) as scout,
        ):
            mishaps = _Mishaps(scout, folder, core, options.stop_s)
            if not mishaps.drives():
                raise SystemExit(f"the robot does not drive:\n{scout.log.read_text()}")
            _tell("up", **mishaps.state())
            failed = [one for one in options.names or _NAMES if not _withstood(mishaps, one)]
    return int(bool(failed))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stop-s", type=float, default=20.0, help="how long processes are stopped")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(_NAMES))
    return parser.parse_args()


@contextlib.contextmanager
def _hub(folder: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """Run a `roscore`, which carries the hub."""
    port = str(20_000 + os.getpid() % 10_000)
    own = {"GAZELLE_PORT": port, _MARK: folder.name, "ROS_HOME": str(folder / "core_home")}
    with (folder / "core.log").open("wb") as log:
        core = subprocess.Popen(
            [sys.executable, "-m", "gazelle.cli", "roscore"], env={**os.environ, **own},
            stdout=log, stderr=log,
        )  # fmt: skip
    try:
        _until(lambda: _answers(port), "roscore did not come up")
        yield port, core
    finally:
        core.kill()
        core.wait()


def _answers(port: str) -> bool:
    try:
        with Graph.open(role="client", environ={"GAZELLE_PORT": port}):
            return True
    except NoGraphError:
        return False


def _shifted_clock(folder: Path) -> dict[str, str]:
    """Return variables for processes whose clock `_shift_clock` sets; none without a compiler."""
    compiler = shutil.which("cc")
    if compiler is None:
        return {}
    source, library = folder / "clock.c", folder / "clock.so"
    source.write_text(_SHIFTED_CLOCK, encoding="utf-8")
    words = [compiler, "-O1", "-shared", "-fPIC", "-o", str(library), str(source), "-ldl"]
    subprocess.run(words, check=True)
    (folder / _SHIFT).write_bytes(bytes(8))
    return {"LD_PRELOAD": str(library), "CLOCK_SHIFT": str(folder / _SHIFT)}


def _shift_clock(folder: Path, seconds: int) -> None:
    with (folder / _SHIFT).open("r+b") as file:
        file.write(seconds.to_bytes(8, sys.byteorder, signed=True))


class _Mishaps:
    """What can happen to the robot; each returns what is to stand in the log afterwards."""

    def __init__(self, scout: LaunchedScout, folder: Path, core: Any, stop_s: float) -> None:
        self.scout = scout
        self._folder, self._core, self._stop_s = folder, core, stop_s
        self._node = scout.graph.create_node("mishaps", rosout=False)
        twist = message_type("geometry_msgs/msg/Twist")
        self._command = self._node.create_publisher("/cmd_vel", twist)
        self._x_m, self._y_m, self._ticks = 0.0, 0.0, 0
        self._node.create_subscription("/odom", "nav_msgs/msg/Odometry", self._on_odometry)

    def state(self) -> dict[str, float]:
        """Return where the robot is and how many messages told so."""
        return {"x_m": round(self._x_m, 3), "y_m": round(self._y_m, 3), "messages": self._ticks}

    def drives(self) -> bool:
        """Tell whether the robot does what it is told."""
        x_m, y_m = self._x_m, self._y_m
        message = self._command.message_class()
        message.angular.z = 0.8
        message.linear.x = 0.3

        def has_moved() -> bool:
            self._command.publish(message)
            return abs(self._x_m - x_m) + abs(self._y_m - y_m) > _DRIVEN_M

        moved = _waits(has_moved)
        self._command.publish(self._command.message_class())
        return moved

    def lists(self) -> bool:
        """Tell whether `rostopic list` answers."""
        done = subprocess.run(
            [sys.executable, "-m", "gazelle.cli", "rostopic", "list"],
            env=dict(self.scout.environ), capture_output=True, text=True, timeout=_PATIENCE_S,
            check=False,
        )  # fmt: skip
        return done.returncode == 0 and "/odom" in done.stdout.split()

    def simulator_stopped(self) -> str:
        """Stop the simulator."""
        self._stop("gzserver")
        return r"nothing was computed for \d+\.\d s: this process was stopped"

    def node_stopped(self) -> str:
        """Stop the process of the light nodes, one of which publishes the robot's frames."""
        self._stop("--host")
        return r"\] process is stopped \[pid \d+\](?s:.*)\] process goes on after \d+\.\d s"

    def launcher_stopped(self) -> str:
        """Stop the launch itself."""
        self._stop("roslaunch")
        return ""

    def clock_set_back(self) -> str:
        """Set the clock of all processes of the launch back by an hour; it stays there."""
        if "LD_PRELOAD" not in self.scout.environ:
            return ""
        _shift_clock(self._folder, -3600)
        self._settle()
        return r"the system's clock was set back by 3600\.0 s"

    def disk_full(self) -> str:
        """Let a recorder reach its file size's limit."""
        limits = (_FILE_BYTES, resource.getrlimit(resource.RLIMIT_FSIZE)[1])
        recorder = self._record("full.bag")
        resource.prlimit(recorder.pid, resource.RLIMIT_FSIZE, limits)
        if recorder.wait(_PATIENCE_S) != 1:
            return "the recorder ends with 1"
        left = open_bag(self._folder / "full.bag.active")
        if not sum(1 for _ in left.messages()):
            return "messages are left in the bag"
        return r"Error writing to file: .*full\.bag\.active: File too large"

    def folder_removed(self) -> str:
        """Remove the folder of the logs, and that of a bag that is being recorded."""
        (self._folder / "bags").mkdir()
        recorder = self._record("bags/removed.bag")
        shutil.rmtree(self._folder / "bags")
        shutil.rmtree(Path(self.scout.environ["ROS_HOME"]))
        self._settle()
        recorder.send_signal(signal.SIGINT)
        if recorder.wait(_PATIENCE_S) != 0:
            return "the recorder ends with 0"
        if not sum(1 for _ in open_bag(self._folder / "bags" / "removed.bag").messages()):
            return "messages are left in the bag"
        return r"somebody removed the file of '.*removed\.bag'; it is written anew"

    def hub_unplugged(self) -> str:
        """Kill `roscore`; another process carries the hub from then on."""
        self._core.kill()
        self._core.wait()
        return ""

    def _stop(self, word: str) -> None:
        found = self._processes(word)
        if not found:
            raise SystemExit(f"no process has {word} in its command")
        for one in found:
            one.suspend()
        time.sleep(self._stop_s)
        for one in found:
            one.resume()

    def _processes(self, word: str) -> list[psutil.Process]:
        found = []
        for pid in pids_of(_MARK, self._folder.name):
            with contextlib.suppress(psutil.Error):
                process = psutil.Process(pid)
                if any(word in one for one in process.cmdline()[2:5]):
                    found.append(process)
        return found

    def _record(self, name: str) -> subprocess.Popen[bytes]:
        path = self._folder / name
        recorder = self.scout.start("gazelle.cli", "rosbag", "record", "-O", str(path), "/odom")
        active = path.with_name(f"{path.name}.active")
        _until(lambda: active.exists() and active.stat().st_size > 50_000, f"no {active}")
        return recorder

    def _settle(self) -> None:
        ticks = self._ticks
        _until(lambda: self._ticks > ticks + 200, "no odometry")

    def _on_odometry(self, message: Any) -> None:
        self._x_m, self._y_m = message.pose.pose.position.x, message.pose.pose.position.y
        self._ticks += 1


_NAMES: dict[str, Callable[[_Mishaps], str]] = {
    "simulator-stopped": _Mishaps.simulator_stopped,
    "node-stopped": _Mishaps.node_stopped,
    "launcher-stopped": _Mishaps.launcher_stopped,
    "clock-set-back": _Mishaps.clock_set_back,
    "disk-full": _Mishaps.disk_full,
    "folder-removed": _Mishaps.folder_removed,
    "hub-unplugged": _Mishaps.hub_unplugged,
}


def _withstood(mishaps: _Mishaps, name: str) -> bool:
    log = mishaps.scout.log
    begin = log.stat().st_size
    begin_s = time.monotonic()
    wanted = _NAMES[name](mishaps)

    def said() -> str:
        return log.read_bytes()[begin:].decode(errors="replace")

    is_said = _waits(lambda: re.search(wanted, said()) is not None)
    drives, lists = mishaps.drives(), mishaps.lists()
    is_up = mishaps.scout.launch.poll() is None
    took_s = round(time.monotonic() - begin_s, 1)
    _tell(name, said=is_said, drives=drives, lists=lists, up=is_up, took_s=took_s)
    good = is_said and drives and lists and is_up
    if not good:
        print(f"wanted: {wanted}\n{said()[-3000:]}", file=sys.stderr)
    return good


def _waits(condition: Callable[[], bool]) -> bool:
    deadline = time.monotonic() + _PATIENCE_S
    while time.monotonic() < deadline:
        if condition():
            return True
        time.sleep(0.1)
    return False


def _until(condition: Callable[[], bool], otherwise: str) -> None:
    if not _waits(condition):
        raise SystemExit(otherwise)


def _tell(what: str, **figures: Any) -> None:
    print(json.dumps({"what": what, **figures}), flush=True)


if __name__ == "__main__":
    sys.exit(main())
