"""SLAMBOT with everything shown in a browser, for as long as one likes: does memory stay flat?

    python benchmarks/soak/studio_soak.py --workspace DIR [--minutes N] [--every-s S]

DIR is the catkin workspace with `slam_robot`. Starts ``slam_robot_gazebo.launch``, opens its page
in headless Chromium with world, robot, scan, cloud, pictures, frames, plot, graph, topics and
console, drives the robot in a circle and brings one tab after the other to the front. Prints one
JSON object per sample and, at the end, how much each figure has grown from the first third to the
last, after a third of the time (at most 5 minutes) to warm up: curves and tracks fill.
Exit code 1 when one has grown more than 5 %.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import psutil

_WARM_UP_S = 300.0
_STARTING_S = 180.0
_MAX_GROWTH = 0.05
_FIGURES = ("page_heap_mb", "renderer_mb", "server_mb", "simulator_mb")
_PANELS = "rviz,gzclient,rqt_plot,rqt_graph,rqt_topic,rqt_console,rqt_image_view,rqt_tf_tree"
_DISPLAYS = {
    "LaserScan": "/scan",
    "PointCloud2": "/depth_camera/depth/points",
    "Image": "/camera/rgb/image_raw",
    "Odometry": "/odom",
}
_FLAGS = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
)
_CHROMIUM = ("chromium", "chromium-browser", "google-chrome")


def main() -> None:
    """Run, print samples, judge."""
    options = _options()
    samples: list[dict[str, float]] = []
    with contextlib.ExitStack() as stack:
        home = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        url = stack.enter_context(_launched(options.workspace, home))
        page, browser_pid = stack.enter_context(_page(url, home))
        probe = _Probe(page, browser_pid, urlsplit(url).port or 0)
        tabs = page.locator(".dv-tab").all()
        begin = time.monotonic()
        while (passed := time.monotonic() - begin) < options.minutes * 60:
            tabs[0].click()
            tabs.append(tabs.pop(0))
            page.wait_for_timeout(options.every_s * 1000)
            sample = {"seconds": round(passed), **probe.sample()}
            print(json.dumps(sample), flush=True)
            if passed > min(_WARM_UP_S, options.minutes * 20):
                samples.append(sample)
    sys.exit(_judge(samples))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--workspace", type=Path, required=True, help="with src/slam_robot")
    parser.add_argument("--minutes", type=float, default=30.0)
    parser.add_argument("--every-s", type=float, default=10.0, help="time between samples")
    return parser.parse_args()


@contextlib.contextmanager
def _launched(workspace: Path, home: Path) -> Iterator[str]:
    """Run the launch file and what drives the robot; gives the page's address."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = str(free.getsockname()[1] % 20_000 + 10_000)
    environ = {
        **os.environ, "GAZELLE_PORT": port, "GAZELLE_STUDIO": "1", "ROS_HOME": str(home / "ros"),
        "XDG_CONFIG_HOME": str(home / "config"),
        "GAZEBO_MODEL_PATH": str(workspace.parent / "gazebo_models"),
    }  # fmt: skip
    gazelle = [sys.executable, "-m", "gazelle.cli"]
    launch = [*gazelle, "roslaunch", "slam_robot", "slam_robot_gazebo.launch"]
    drive = [
        *gazelle, "rostopic", "pub", "-r", "5", "/cmd_vel", "geometry_msgs/Twist",
        "{linear: {x: 0.1}, angular: {z: 0.2}}",
    ]  # fmt: skip
    log = (home / "launch.log").open("w+")
    launching = subprocess.Popen(launch, cwd=workspace, env=environ, stdout=log, stderr=log)
    try:
        url = _address(home / "launch.log", launching)
        driving = subprocess.Popen(drive, env=environ, stdout=log, stderr=log)
        try:
            yield url
        finally:
            driving.terminate()
            driving.wait()
    finally:
        launching.terminate()
        launching.wait()
        log.close()


def _address(log: Path, launching: subprocess.Popen[bytes]) -> str:
    """Wait until the launch has said where its page is."""
    deadline = time.monotonic() + _STARTING_S
    while time.monotonic() < deadline and launching.poll() is None:
        for line in log.read_text(errors="replace").splitlines():
            if line.startswith("gazebo: http://"):
                return line.removeprefix("gazebo: ").strip()
        time.sleep(0.2)
    raise SystemExit(f"the launch has no page:\n{log.read_text(errors='replace')}")


@contextlib.contextmanager
def _page(url: str, home: Path) -> Iterator[tuple[Any, int]]:
    """Open the page with everything shown; gives it and the browser's process."""
    from playwright.sync_api import sync_playwright

    program = next(filter(None, map(shutil.which, _CHROMIUM)), None)
    if program is None:
        raise SystemExit(f"no Chromium is installed (looked for {', '.join(_CHROMIUM)})")
    profile = home / "chromium"
    with sync_playwright() as playwright:
        context = playwright.chromium.launch_persistent_context(
            str(profile), executable_path=program, args=list(_FLAGS),
            viewport={"width": 1600, "height": 1000},
        )  # fmt: skip
        page = context.new_page()
        page.set_default_timeout(_STARTING_S * 1000)
        page.goto(f"{url}&panels={_PANELS}")
        page.wait_for_function("window.gazelle?.scenes().length > 1")
        for display, topic in _DISPLAYS.items():
            page.evaluate(f"gazelle.addDisplay('{display}', {{Topic: '{topic}'}}, 'rviz')")
        page.locator(".dv-tab").filter(has_text="Plot").click()
        page.get_by_label("Topic field").fill("/odom/twist/twist")
        page.keyboard.press("Enter")
        yield page, _browser(profile)
        context.close()


def _browser(profile: Path) -> int:
    """The browser's first process, known by its profile's folder."""
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            words = process.cmdline()
            if f"--user-data-dir={profile}" in words and not any("--type=" in w for w in words):
                return process.pid
    raise SystemExit("the browser's process is not found")


class _Probe:
    """Measures the page, its renderer, its server and the simulator."""

    def __init__(self, page: Any, browser_pid: int, port: int) -> None:
        self._page = page
        self._tools = page.context.new_cdp_session(page)
        self._tools.send("Performance.enable")
        children = psutil.Process(browser_pid).children(recursive=True)
        renderers = [one for one in children if "--type=renderer" in one.cmdline()]
        self._renderer = max(renderers, key=lambda one: one.memory_info().rss)
        self._server = _listening(port)
        self._simulator = _named("gazebo_ros/gzserver", self._server)

    def sample(self) -> dict[str, float]:
        """Return memory in MB after a collection of garbage, and counts of things alive."""
        self._tools.send("HeapProfiler.collectGarbage")
        figures = {one["name"]: one["value"] for one in self._metrics()}
        return {
            "page_heap_mb": round(figures["JSHeapUsedSize"] / 1e6, 2),
            "renderer_mb": round(self._renderer.memory_info().rss / 1e6, 1),
            "server_mb": round(self._server.memory_info().rss / 1e6, 1),
            "simulator_mb": round(self._simulator.memory_info().rss / 1e6, 1),
            "dom_nodes": figures["Nodes"],
            "listeners": figures["JSEventListeners"],
            "geometries": self._page.evaluate(
                "gazelle.scenes().reduce((sum, each) => sum + each.geometries, 0)"
            ),
        }

    def _metrics(self) -> list[dict[str, Any]]:
        return list(self._tools.send("Performance.getMetrics")["metrics"])


def _listening(port: int) -> psutil.Process:
    for one in psutil.net_connections("tcp"):
        if one.status == psutil.CONN_LISTEN and one.laddr[1:] == (port,) and one.pid:
            return psutil.Process(one.pid)
    raise SystemExit(f"nobody listens on port {port}")


def _named(word: str, like: psutil.Process) -> psutil.Process:
    """The process of a node on the same graph as another."""
    port = like.environ()["GAZELLE_PORT"]
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            if word in process.cmdline() and process.environ().get("GAZELLE_PORT") == port:
                return process
    raise SystemExit(f"{word} is not running")


def _judge(samples: list[dict[str, float]]) -> int:
    """Print the growth of each figure; 1 when one is too large."""
    third = max(1, len(samples) // 3)
    growth = {}
    for name in _FIGURES:
        first = statistics.median(one[name] for one in samples[:third])
        last = statistics.median(one[name] for one in samples[-third:])
        growth[name] = round(last / first - 1, 4)
    print(json.dumps({"growth": growth, "samples": len(samples)}))
    return int(any(each > _MAX_GROWTH for each in growth.values()))


if __name__ == "__main__":
    main()
