"""What Studio costs while it shows a robot: clouds, pictures and frames to one page.

Run ``python benchmarks/bench_studio.py``; prints one JSON object per measurement. Talker and
server are processes of their own; the page is a plain WebSocket client in this one that
acknowledges every frame. `core_percent` is the server's CPU time (user and system, all threads)
in per cent of one core. The line `foxglove` is a peer on the same load in the same run: the
bridge of foxglove-sdk, in Rust, with one client that takes the three topics as they are.
"""

from __future__ import annotations

import argparse
import json
import os
import socket
import struct
import subprocess
import sys
import threading
import time
from typing import Any

import numpy as np
import psutil
from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

from gazelle.graph import Graph
from gazelle.interfaces import message_type

FRAMES = 10
LOADS = ("nothing", "tf", "image", "cloud", "everything")
HEADER = struct.Struct("<HHId")


def main() -> None:
    """Measure every load, or be the talker."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=8.0, help="length of each measurement")
    parser.add_argument("--points", type=int, default=300_000, help="points of each cloud")
    parser.add_argument("--loads", nargs="+", default=LOADS, choices=LOADS)
    parser.add_argument("--talk", type=int, default=0, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.talk:
        _talk(options.talk, options.points)
        return
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    environ = {**os.environ, "GAZELLE_PORT": str(port)}
    talker = [sys.executable, __file__, "--talk", str(port), "--points", str(options.points)]
    studio = [sys.executable, "-m", "gazelle.cli", "studio", "--port", "0", "--no-browser"]
    with subprocess.Popen(talker, env=environ, stdin=subprocess.PIPE) as one:
        with subprocess.Popen(studio, env=environ, stdout=subprocess.PIPE, text=True) as other:
            assert other.stdout is not None
            url = other.stdout.readline().split()[-1]
            for load in options.loads:
                _measure(load, url, psutil.Process(other.pid), options.seconds)
            other.terminate()
        if "everything" in options.loads:
            _measure_peer(environ, options.seconds)
        one.communicate(b"\n")


def _measure(load: str, url: str, process: psutil.Process, seconds: float) -> None:
    address = url.replace("http", "ws") + "ws"
    with connect(address, compression=None, max_size=None) as page:
        page.recv()
        for number, (stream, params) in enumerate(_streams(load), 1):
            opening = {"op": "open", "ch": number, "stream": stream, "params": params}
            page.send(json.dumps(opening))
        _read_for(page, 2.0)
        begin, used = time.perf_counter(), _cpu_s(process)
        counts, size = _read_for(page, seconds)
        passed = time.perf_counter() - begin
        _say(
            load,
            core_percent=100 * (_cpu_s(process) - used) / passed,
            frames_per_s={name: round(count / passed, 1) for name, count in counts.items()},
            mb_per_s=size / passed / 1e6,
        )


def _measure_peer(environ: dict[str, str], seconds: float) -> None:
    """What foxglove-sdk's server costs that shows the same topics."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    words = [sys.executable, "-m", "gazelle.cli", "bridge", "foxglove", "-p", str(port)]
    with subprocess.Popen(words, env=environ, stdout=subprocess.DEVNULL) as bridge:
        page = _viewer(port)
        with page:
            _take_for(page, 2.0)
            process = psutil.Process(bridge.pid)
            begin, used = time.perf_counter(), _cpu_s(process)
            messages, size = _take_for(page, seconds)
            passed = time.perf_counter() - begin
            _say(
                "foxglove",
                core_percent=100 * (_cpu_s(process) - used) / passed,
                messages_per_s=messages / passed,
                mb_per_s=size / passed / 1e6,
            )
        bridge.terminate()


def _viewer(port: int) -> ClientConnection:
    """Return a client of the peer that has subscribed to the three topics."""
    address, names = f"ws://127.0.0.1:{port}", {"/points", "/image", "/tf"}
    end = time.monotonic() + 20.0
    while True:
        try:
            page = connect(
                address, subprotocols=[Subprotocol("foxglove.sdk.v1")], max_size=None,
                compression=None,
            )  # fmt: skip
            break
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)
    while names:
        message = page.recv(20.0)
        if isinstance(message, bytes) or (value := json.loads(message))["op"] != "advertise":
            continue
        for channel in value["channels"]:
            if channel["topic"] in names:
                names.discard(channel["topic"])
                wanted = [{"id": channel["id"], "channelId": channel["id"]}]
                page.send(json.dumps({"op": "subscribe", "subscriptions": wanted}))
    return page


def _take_for(page: ClientConnection, seconds: float) -> tuple[int, int]:
    count = size = 0
    end = time.perf_counter() + seconds
    while (left := end - time.perf_counter()) > 0:
        try:
            message = page.recv(left)
        except TimeoutError:
            break
        count, size = count + 1, size + len(message)
    return count, size


def _streams(load: str) -> list[tuple[str, dict[str, Any]]]:
    cloud = {
        "display": "PointCloud2",
        "topic": "/points",
        "fixed_frame": "map",
        "Color Transformer": "Intensity",
    }
    rows: dict[str, tuple[str, dict[str, Any]]] = {
        "tf": ("tf", {"fixed_frame": "map"}),
        "image": ("image", {"topic": "/image"}),
        "cloud": ("display", cloud),
    }
    return list(rows.values()) if load == "everything" else [rows[load]] if load in rows else []


def _read_for(page: ClientConnection, seconds: float) -> tuple[dict[str, int], int]:
    """Acknowledge what comes, return frames by kind and bytes."""
    names = {2: "tf", 10: "image", 20: "cloud", 29: "cloud"}
    counts: dict[str, int] = {}
    size = 0
    end = time.perf_counter() + seconds
    while (left := end - time.perf_counter()) > 0:
        try:
            message = page.recv(left)
        except TimeoutError:
            break
        if isinstance(message, str):
            value = json.loads(message)
            if value["op"] == "data":
                page.send(json.dumps({"op": "ack", "ch": value["ch"]}))
            elif value["op"] not in ("opened",):
                _say("the server says", **value)
            continue
        channel, kind, _, _ = HEADER.unpack_from(message)
        page.send(json.dumps({"op": "ack", "ch": channel}))
        counts[names[kind]] = counts.get(names[kind], 0) + 1
        size += len(message)
    return counts, size


def _cpu_s(process: psutil.Process) -> float:
    times = process.cpu_times()
    return float(times.user + times.system)


def _talk(port: int, points: int) -> None:
    """Publish clouds and pictures at 20 Hz and frames at 100 Hz while somebody listens."""
    with Graph.open(port=port, environ={}, role="hub") as graph:
        node = graph.create_node("talker", rosout=False)
        ended = threading.Event()
        threads = [
            threading.Thread(target=_repeat, args=(node, *row, ended), daemon=True)
            for row in (
                ("/points", _cloud(points), 20.0),
                ("/image", _image(), 20.0),
                ("/tf", _transforms(), 100.0),
            )
        ]
        for thread in threads:
            thread.start()
        sys.stdin.read(1)
        ended.set()


def _repeat(node: Any, topic: str, message: Any, rate_hz: float, ended: threading.Event) -> None:
    publisher = node.create_publisher(topic, type(message), reliable=False)
    due = time.monotonic()
    while not ended.wait(max(0.0, due - time.monotonic())):
        due = max(due + 1 / rate_hz, time.monotonic() - 1 / rate_hz)
        stamp_ns = time.time_ns()
        headers = [one.header for one in getattr(message, "transforms", [message])]
        for header in headers:
            header.stamp.sec, header.stamp.nanosec = divmod(stamp_ns, 1_000_000_000)
        if publisher.matched:
            publisher.publish(message)


def _cloud(points: int) -> Any:
    field = message_type("sensor_msgs/msg/PointField")
    values = np.random.default_rng(1).normal(0.0, 5.0, (points, 4)).astype(np.float32)
    return _framed(
        "sensor_msgs/msg/PointCloud2",
        "frame_3",
        height=1,
        width=points,
        fields=[
            field(name=name, offset=4 * place, datatype=7, count=1)
            for place, name in enumerate(("x", "y", "z", "intensity"))
        ],
        point_step=16,
        row_step=16 * points,
        data=values.view(np.uint8).reshape(-1),
        is_dense=True,
    )


def _image() -> Any:
    rows, columns = np.mgrid[0:480, 0:640]
    pixels = np.dstack([rows // 2, columns // 3, (rows + columns) % 256]).astype(np.uint8)
    noise = np.random.default_rng(2).integers(0, 12, pixels.shape, np.uint8)
    data = (pixels // 2 + noise).reshape(-1)
    return _framed(
        "sensor_msgs/msg/Image", "frame_1", height=480, width=640, encoding="rgb8", step=1920,
        data=data,
    )  # fmt: skip


def _transforms() -> Any:
    made = message_type("tf2_msgs/msg/TFMessage")()
    for number in range(FRAMES):
        one = _framed(
            "geometry_msgs/msg/TransformStamped", f"frame_{number - 1}" if number else "map"
        )
        one.child_frame_id = f"frame_{number}"
        one.transform.rotation.w = 1.0
        made.transforms.append(one)
    return made


def _framed(type_name: str, frame: str, **fields: Any) -> Any:
    message = message_type(type_name)(**fields)
    message.header.frame_id = frame
    return message


def _say(what: str, **figures: Any) -> None:
    rounded = {
        name: round(value, 2) if isinstance(value, float) else value
        for name, value in figures.items()
    }
    print(json.dumps({"what": what, **rounded}), flush=True)


if __name__ == "__main__":
    main()
