"""Speed of nodes in C++ beside nodes in Python, and beside real roscpp where it is installed.

Run ``python benchmarks/bench_cpp.py``; prints one JSON object per measurement. What counts is the
ratio of measurements of one run: each pair is measured in turn, several times, and the best of
each is told. The same source (``peers/cpp/message_rates.cpp``) is compiled for Gazelle and for
ROS; for the latter `--ros-program` and `--rosmaster` say what to run, if not what Debian has.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

_HERE = Path(__file__).parent / "peers" / "cpp"
_LIBRARIES = "-lroscpp -lrosconsole -lrostime -lroscpp_serialization -lboost_thread -lboost_system"
_PORT = 17_900
_MASTER_PORT = 17_311

Results = dict[str, dict[str, float]]


def main() -> None:
    """Compile the program and measure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=2000, help="round trips to measure")
    parser.add_argument("--images", type=int, default=100, help="images to send")
    parser.add_argument("--turns", type=int, default=3, help="how often each is measured")
    parser.add_argument("--ros-program", help="message_rates.cpp compiled for ROS already")
    parser.add_argument("--rosmaster", default="rosmaster --core", help="starts ROS's master")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = _compiled(Path(folder))
        real = options.ros_program or _compiled_for_ros(Path(folder))
        cpp = [sys.executable, "-m", "gazelle.cpp.host", str(program)]
        script = str(_HERE / "message_rates.py")
        python = [sys.executable, "-m", "gazelle.compat.script_runner", script]
        counts = [str(options.rounds), str(options.images)]
        found: dict[str, Results] = {}
        for _ in range(options.turns):
            for name, words in (("rospy of Gazelle", python), ("roscpp of Gazelle", cpp)):
                with _graph():
                    _note(found, name, _measured(words, counts, name))
            with _graph():
                _note(found, "roscpp of Gazelle", _lines([*cpp, "inside", "200000"]))
            if real:
                with _master(options.rosmaster.split()):
                    _note(found, "roscpp of ROS", _measured([real], counts, "roscpp of ROS"))
                    _note(found, "roscpp of ROS", _lines([real, "inside", "200000"]))
    for name, results in found.items():
        for what, values in results.items():
            print(json.dumps({"nodes": name, "what": what, **values}))
    _tell_ratios(found)


def _tell_ratios(found: dict[str, Results]) -> None:
    base, cpp = found["rospy of Gazelle"], found["roscpp of Gazelle"]
    for what in ("round trip", "image of 1 MB"):
        ratio = base[what]["p50_us"] / cpp[what]["p50_us"]
        print(json.dumps({"ratio": f"{what}: C++ is so many times as fast", "times": ratio}))
    more_kb = cpp["memory"]["peak_kb"] - base["memory"]["peak_kb"]
    print(json.dumps({"ratio": "memory: C++ takes so much more", "kb": more_kb}))


def _note(found: dict[str, Results], name: str, more: Results) -> None:
    """Keep the better of two measurements of the same."""
    results = found.setdefault(name, {})
    for what, values in more.items():
        known = results.setdefault(what, values)
        for key, value in values.items():
            known[key] = (max if key.endswith("_per_s") else min)(known[key], value)


def _measured(words: list[str], counts: list[str], name: str) -> Results:
    with subprocess.Popen([*words, "answer"], stdout=subprocess.PIPE, text=True) as peer:
        assert peer.stdout is not None
        line = peer.stdout.readline()
        assert line.strip() == "ready", f"{name}: {line}"
        try:
            found = _lines([*words, "ask", *counts])
            found["memory"] = {"peak_kb": _peak_kb(peer.pid)}
        finally:
            peer.terminate()
    return found


def _lines(words: list[str]) -> Results:
    """Run a program and return what it measured."""
    output = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout
    read = [json.loads(line) for line in output.splitlines() if line.startswith("{")]
    return {one.pop("what"): one for one in read}


def _peak_kb(pid: int) -> float:
    status = Path(f"/proc/{pid}/status").read_text(encoding="ascii")
    line = next(line for line in status.splitlines() if line.startswith("VmHWM"))
    return float(line.split()[1])


@contextlib.contextmanager
def _graph() -> Iterator[None]:
    """A graph of its own: the hub is a process that does nothing else."""
    os.environ["GAZELLE_PORT"] = str(_PORT)
    with _running([sys.executable, "-m", "gazelle.cli", "roscore"]):
        yield


@contextlib.contextmanager
def _master(words: list[str]) -> Iterator[None]:
    os.environ["ROS_MASTER_URI"] = f"http://localhost:{_MASTER_PORT}"
    with _running([*words, "-p", str(_MASTER_PORT)]):
        yield
    del os.environ["ROS_MASTER_URI"]


@contextlib.contextmanager
def _running(words: list[str]) -> Iterator[None]:
    nowhere = subprocess.DEVNULL
    with subprocess.Popen(words, stdout=nowhere, stderr=nowhere) as one:
        time.sleep(3)
        try:
            yield
        finally:
            one.terminate()


def _compiled(folder: Path) -> Path:
    """Compile for Gazelle, and tell how long it takes once the runtime is there."""
    program = folder / "message_rates"
    source = str(_HERE / "message_rates.cpp")
    words = [sys.executable, "-m", "gazelle.cpp.compile", source, "-o", str(program), "--ros", "1"]
    for what in ("compile, first", "compile, runtime there"):
        begin = time.perf_counter()
        subprocess.run(words, check=True)
        print(json.dumps({"what": what, "s": time.perf_counter() - begin}), flush=True)
    return program


def _compiled_for_ros(folder: Path) -> str:
    """Compile for the ROS of this machine; empty where there is none."""
    if shutil.which("g++") is None or not Path("/usr/include/ros/ros.h").is_file():
        return ""
    program = str(folder / "message_rates_ros")
    source = str(_HERE / "message_rates.cpp")
    words = ["g++", "-O2", "-std=gnu++17", source, "-o", program, *_LIBRARIES.split()]
    return program if subprocess.run(words, check=False).returncode == 0 else ""


if __name__ == "__main__":
    main()
