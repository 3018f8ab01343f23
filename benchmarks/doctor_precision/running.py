"""How soon a launch tells of mistakes that only show while it runs.

Run ``python benchmarks/doctor_precision/running.py`` from the repository. Programs of new packages
are made to fail in ways that no reading can see: by what a message holds, by what a parameter is.
Each is launched; what counts is the time from the first line that its node could have run until
file and line of the mistake stand on the terminal, and that they do so once.
"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

_PATIENCE_S = 40.0
_STARTED = re.compile(r"wander-\d+\]: started|process started with pid", re.IGNORECASE)


class Mistake(NamedTuple):
    """A change of a program, and what has to be said of it."""

    name: str
    ros_version: int
    right: str
    wrong: str
    told: str


MISTAKES = (
    Mistake("field of a message", 1, "enumerate(scan.ranges)", "enumerate(scan.rangse)", "rangse"),
    Mistake("parameter that is not set", 1, '"~speed", 0.3', '"~max_speed"', "max_speed"),
    Mistake("value of another type", 1, "linear.x = self.speed", 'linear.x = "fast"', "linear"),
    Mistake("module that is not there", 1, "import math\n", "import math\nimport mathh\n", "mathh"),
    Mistake("field of a message", 2, "enumerate(scan.ranges)", "enumerate(scan.rangse)", "rangse"),
    Mistake("parameter of another type", 2, '"speed", 0.3', '"speed", "fast"', "speed"),
    Mistake("value of another type", 2, "linear.x = self.speed", 'linear.x = "fast"', "float"),
    Mistake("module that is not there", 2, "import math\n", "import math\nimport mathh\n", "mathh"),
)


def main() -> None:
    """Launch each and print what was seen."""
    from gazelle.workspace.scaffold import create_package

    print(f"{'mistake':30} ROS  told after  times")
    for number, mistake in enumerate(MISTAKES):
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder) / "src"
            source.mkdir()
            create_package("robot", "bot", source, ros_version=mistake.ros_version)  # type: ignore[arg-type]
            scripts = source / "bot" / ("scripts" if mistake.ros_version == 1 else "bot")
            path = scripts / "wander.py"
            text = path.read_text("utf-8")
            assert mistake.right in text, mistake
            path.write_text(text.replace(mistake.right, mistake.wrong, 1), "utf-8")
            seconds, times = _launched(mistake, Path(folder), 11500 + number)
        shown = "never" if seconds is None else f"{seconds:.1f} s"
        print(f"{mistake.name:30} {mistake.ros_version:3}  {shown:>10}  {times:5}", flush=True)


def _launched(mistake: Mistake, folder: Path, port: int) -> tuple[float | None, int]:
    words = ["roslaunch", "bot", "bot.launch", "gui:=false"]
    if mistake.ros_version != 1:
        words = ["ros2", "launch", "bot", "bot.launch.py"]
    environ = {
        **os.environ, "GAZELLE_STUDIO": "0", "PYTHONUNBUFFERED": "1",
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_DOMAIN_ID": str(port % 200),
        "ROS_PACKAGE_PATH": str(folder / "src"),
    }  # fmt: skip
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli", *words], cwd=folder, env=environ,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
    )  # fmt: skip
    assert process.stdout is not None
    os.set_blocking(process.stdout.fileno(), False)
    begin, text, started, told = time.monotonic(), "", None, None
    try:
        while time.monotonic() - begin < _PATIENCE_S:
            text += (process.stdout.read() or b"").decode(errors="replace")
            now = time.monotonic()
            if started is None and _STARTED.search(text):
                started = now
            is_told = "wander.py" in text and mistake.told in text.partition("wander.py")[2]
            if told is None and is_told:
                told = now
            if told is not None and now - told > 3.0:
                break
            time.sleep(0.05)
    finally:
        os.killpg(process.pid, signal.SIGINT)
        try:
            process.wait(15.0)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
    times = len(re.findall(r"(?m)^(?:\[[^\]]*\] )?[\w.]*(?:Error|Exception)\b.*", text))
    return (None if told is None else told - (started or begin)), times


if __name__ == "__main__":
    main()
