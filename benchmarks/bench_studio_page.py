"""What Studio's page costs the browser, and what one page costs the simulation.

    python benchmarks/bench_studio_page.py [--workspaces FOLDER] [--seconds S] [--parts …]

Prints one JSON object per measurement:

- `load`: script and main thread time of the page in per cent of a core, as Chromium counts the
  thread's own time (painting is elsewhere), while RViz's panel shows a 20 Hz cloud of 300,000
  points in the page's budget, 20 Hz pictures of 640×480 and frames at 100 Hz.
- `opening`: time from asking for the page to its first view, and what was transferred, meshes
  and textures apart, as sent (gzip).
- `slowing`: how fast SLAMBOT runs (its scan is computed all the time, nobody asks for its cameras)
  with and without a plain WebSocket client that shows what a page does; in turns, medians of each
  client's turn against the turns around it. In real time as its launch file says, and ``--fast``,
  where all processes together want more than two cores have.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import signal
import socket
import statistics
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from websockets.sync.client import connect

FLAGS = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
CLOUDS_HZ = 20.0
PARTS = ("load", "opening", "slowing")
DISPLAYS = {
    "PointCloud2": {"Topic": "/points"},
    "Image": {"Topic": "/image"},
    "TF": {},
}
# Notes when every 3D view has drawn what it is there for.
FIRST_VIEW = """(function look() {
  const isSeen = (view) => view.drawn > 0 && (view.kind === 'rviz' || view.bodies > 0);
  const views = window.gazelle?.scenes?.() ?? [];
  if (views.length && views.every(isSeen)) window.firstView_ms = performance.now();
  else requestAnimationFrame(look);
})()"""
# What a page with Gazebo's window and RViz's scan has open.
STREAMS: tuple[tuple[str, dict[str, Any]], ...] = (
    ("graph", {}),
    ("world.scene", {}),
    ("world.poses", {}),
    ("world.stats", {}),
    ("tf", {"fixed_frame": "odom"}),
    ("display", {"display": "LaserScan", "topic": "/scan", "fixed_frame": "odom"}),
)


def main() -> None:
    """Measure the wanted parts."""
    parser = argparse.ArgumentParser(description=__doc__)
    shared = Path(__file__).parents[2] / "shared" / "workspaces"
    parser.add_argument("--workspaces", type=Path, default=shared)
    parser.add_argument("--seconds", type=float, default=8.0, help="length of each measurement")
    parser.add_argument("--repeats", type=int, default=4, help="turns of `slowing`")
    parser.add_argument("--parts", nargs="+", default=PARTS, choices=PARTS)
    options = parser.parse_args()
    if "load" in options.parts:
        measure_load(options.seconds)
    if "opening" in options.parts:
        measure_opening(options.workspaces)
    if "slowing" in options.parts:
        for words in ((), ("--fast",)):
            measure_slowing(options.workspaces, options.seconds, options.repeats, *words)


def measure_load(seconds: float) -> None:
    """Show everything at once in RViz's panel."""
    port = free_port()
    talker = [sys.executable, str(Path(__file__).with_name("bench_studio.py")), "--talk", str(port)]
    with running(talker, port), studio(port) as url, browser() as chromium:
        # Small, because a graphics card would paint this.
        page = chromium.new_page(viewport={"width": 640, "height": 400})
        page.goto(f"{url}&panels=rviz")
        until(page, "Boolean(window.gazelle?.scene)")
        for display, properties in DISPLAYS.items():
            page.evaluate(f"gazelle.addDisplay('{display}', {json.dumps(properties)}, 'rviz')")
        until(page, "gazelle.scene('rviz').displays['PointCloud2'].counts.points > 0")
        page.wait_for_timeout(3000)
        session = page.context.new_cdp_session(page)
        session.send("Performance.enable", {"timeDomain": "threadTicks"})
        before, shown = _metrics(session), _shown(page)
        began = time.perf_counter()
        page.wait_for_timeout(seconds * 1000)
        after, now = _metrics(session), _shown(page)
        passed = time.perf_counter() - began
        script = 100 * (after["ScriptDuration"] - before["ScriptDuration"]) / passed
        clouds_hz = (now["clouds"] - shown["clouds"]) / passed
        say(
            "page",
            script_percent=script,
            # Where software paints, fewer clouds are shown than come.
            script_percent_at_20_hz=script * CLOUDS_HZ / clouds_hz if clouds_hz else None,
            main_thread_percent=100 * (after["TaskDuration"] - before["TaskDuration"]) / passed,
            per_s={name: round((now[name] - shown[name]) / passed, 1) for name in now},
            heap_mb=after["JSHeapUsedSize"] / 1e6,
        )


def _metrics(session: Any) -> dict[str, float]:
    rows = session.send("Performance.getMetrics")["metrics"]
    return {row["name"]: row["value"] for row in rows}


def _shown(page: Any) -> dict[str, int]:
    script = """() => {
      const {displays, drawn} = gazelle.scene('rviz');
      const count = (name) => displays[name].counts.messages;
      return {clouds: count('PointCloud2'), pictures: count('Image'), drawn};
    }"""
    return dict(page.evaluate(script))


def measure_opening(workspaces: Path) -> None:
    """Open Gazebo's window on SLAMBOT's museum, as a launch file does, and RViz's beside it."""
    with slambot(workspaces) as (port, _), studio(port) as url, browser() as chromium:
        _warm_up(chromium)
        for panels in ("gzclient", "rviz", ""):
            context = chromium.new_context(viewport={"width": 1280, "height": 800})
            page = context.new_page()
            session = context.new_cdp_session(page)
            session.send("Network.enable")
            sizes = _sizes(session)
            page.add_init_script(FIRST_VIEW)
            page.goto(f"{url}&panels={panels}" if panels else url)
            until(page, "window.firstView_ms > 0")
            first_ms = page.evaluate("window.firstView_ms")
            page.wait_for_timeout(1500)
            own = sum(size for path, size in sizes.items() if not _is_mesh(path))
            say(
                f"opening {panels or 'everything'}",
                first_view_s=first_ms / 1000,
                transfer_kb=own / 1000,
                files=sum(not _is_mesh(path) for path in sizes),
                meshes_kb=(sum(sizes.values()) - own) / 1000,
            )
            context.close()


def _warm_up(chromium: Any) -> None:
    """A person's browser has painted something before."""
    page = chromium.new_page()
    page.evaluate("document.createElement('canvas').getContext('webgl2').finish()")
    page.close()


def _sizes(session: Any) -> dict[str, int]:
    """Return a mapping that fills with bytes as sent, headers too, by URL."""
    names: dict[str, str] = {}
    sizes: dict[str, int] = {}

    def begun(event: Any) -> None:
        names[event["requestId"]] = event["request"]["url"]

    def ended(event: Any) -> None:
        url = names.get(event["requestId"], "")
        sizes[url] = sizes.get(url, 0) + int(event["encodedDataLength"])

    session.on("Network.requestWillBeSent", begun)
    session.on("Network.loadingFinished", ended)
    return sizes


def _is_mesh(url: str) -> bool:
    return any(part in url for part in ("/mesh/", "/texture/", "/thumbnail/"))


def measure_slowing(workspaces: Path, seconds: float, repeats: int, *options: str) -> None:
    """Look at SLAMBOT and look away, in turns."""
    alone: list[float] = []
    looked_at: list[float] = []
    with slambot(workspaces, *options) as (port, node), studio(port) as url:
        for _ in range(repeats):
            alone.append(_factor(node, seconds))
            with _client(url):
                time.sleep(1.0)
                looked_at.append(_factor(node, seconds))
        alone.append(_factor(node, seconds))
    # The machine's own speed drifts: each turn is compared with its neighbours.
    shares = [
        2 * seen / (before + after)
        for before, seen, after in zip(alone, looked_at, alone[1:], strict=False)
    ]
    say(
        " ".join(("slowing", *options)),
        alone=[round(each, 2) for each in alone],
        with_client=[round(each, 2) for each in looked_at],
        slower_percent=100 * (1 - statistics.median(shares)),
    )


@contextlib.contextmanager
def _client(url: str) -> Iterator[None]:
    """A page as the server sees it, which takes everything at once."""
    address = url.replace("http", "ws").replace("/?", "/ws?")
    with connect(address, compression=None, max_size=None) as page:
        page.recv()
        for number, (stream, params) in enumerate(STREAMS, 1):
            opening = {"op": "open", "ch": number, "stream": stream, "params": params}
            page.send(json.dumps(opening))
        ended = threading.Event()
        reader = threading.Thread(target=_take, args=(page, ended))
        reader.start()
        try:
            yield
        finally:
            ended.set()
            reader.join()


def _take(page: Any, ended: threading.Event) -> None:
    while not ended.is_set():
        with contextlib.suppress(TimeoutError):
            message = page.recv(0.2)
            if isinstance(message, bytes):
                channel = int.from_bytes(message[:2], "little")
            else:
                value = json.loads(message)
                if value["op"] in ("failed", "ended"):
                    raise SystemExit(f"the server says {message[:300]}")
                if value["op"] != "data":
                    continue
                channel = value["ch"]
            page.send(json.dumps({"op": "ack", "ch": channel}))


def _factor(node: Any, seconds: float) -> float:
    """Return simulated seconds per second."""
    from gazelle.interfaces import service_type

    kind = service_type("gazebo_msgs/srv/GetWorldProperties")
    client = node.create_client("/gazebo/get_world_properties", kind)
    client.wait_for_service(20)
    first, began = client.call(kind.Request(), timeout_s=20).sim_time, time.perf_counter()
    time.sleep(seconds)
    last, ended = client.call(kind.Request(), timeout_s=20).sim_time, time.perf_counter()
    return float((last - first) / (ended - began))


@contextlib.contextmanager
def slambot(workspaces: Path, *options: str) -> Iterator[tuple[int, Any]]:
    """SLAMBOT's launch file without a page of its own: its port and a node on its graph."""
    if not workspaces.is_dir():
        raise SystemExit(f"there are no workspaces at {workspaces}; name them with --workspaces")
    from gazelle.graph import Graph

    port = free_port()
    own = {
        "ROS_PACKAGE_PATH": str(workspaces / "catkin_ws" / "src"),
        "GAZEBO_MODEL_PATH": str(workspaces / "gazebo_models"),
        "GAZELLE_STUDIO": "0",
    }
    words = ["roslaunch", "slam_robot", "slam_robot_gazebo.launch", *options]
    with running([sys.executable, "-m", "gazelle.cli", *words], port, **own):
        # The launch is the hub: it has to be there first.
        wait_for(port)
        with Graph.open(port=port, environ={}, role="client") as graph:
            node = graph.create_node("bench", anonymous=True, rosout=False)
            scanned = threading.Event()
            node.create_subscription("/scan", "sensor_msgs/msg/LaserScan", lambda _: scanned.set())
            if not scanned.wait(90):
                raise SystemExit("no scan within 90 s")
            yield port, node


@contextlib.contextmanager
def studio(port: int) -> Iterator[str]:
    """``gazelle studio`` on a graph; its address."""
    words = ["studio", "--port", "0", "--no-browser"]
    command = [sys.executable, "-m", "gazelle.cli", *words]
    with running(command, port, stdout=subprocess.PIPE) as process:
        yield process.stdout.readline().split()[-1]


@contextlib.contextmanager
def running(command: list[str], port: int, *, stdout: Any = None, **environ: str) -> Iterator[Any]:
    """A process on a graph, ended with the block."""
    with subprocess.Popen(
        command,
        env={**os.environ, "GAZELLE_PORT": str(port), **environ},
        stdin=subprocess.PIPE,
        stdout=stdout or subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        text=True,
    ) as process:
        try:
            yield process
        finally:
            process.send_signal(signal.SIGINT)
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(20)
            process.kill()


@contextlib.contextmanager
def browser() -> Iterator[Any]:
    """A headless Chromium."""
    from playwright.sync_api import sync_playwright

    program = shutil.which("chromium") or shutil.which("google-chrome")
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=program, args=FLAGS)
        yield started
        started.close()


def until(page: Any, condition: str) -> None:
    """Wait for a condition; Playwright's own way is barred by the page's policy."""
    for _ in range(1200):
        if page.evaluate(condition):
            return
        page.wait_for_timeout(50)
    raise SystemExit(f"within a minute it never was true that {condition}")


def free_port() -> int:
    """Return a free TCP port."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def wait_for(port: int) -> None:
    """Wait until something listens on a port."""
    for _ in range(600):
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", port)) == 0:
                return
        time.sleep(0.1)
    raise SystemExit(f"nothing listens on port {port} after a minute")


def say(what: str, **figures: Any) -> None:
    """Print one measurement."""
    rounded = {
        name: round(value, 2) if isinstance(value, float) else value
        for name, value in figures.items()
    }
    print(json.dumps({"what": what, **rounded}), flush=True)


if __name__ == "__main__":
    main()
