"""The real RViz of ROS 1 looks at a running SLAMBOT through the bridge: robot and laser in pixels.

Needs rviz, xvfb and imagemagick (Debian: ``apt-get install rviz xvfb imagemagick``) and the
documents' catkin workspace. Run as ``python benchmarks/peers/rviz_ros1.py WORKSPACES [PICTURE]``.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

_PORT = 17_551
_MASTER = "http://127.0.0.1:17552"
_DISPLAY = ":78"
_SIZE = (1024, 768)
_PATIENCE_S = 60.0
_WARM_UP_S = 5.0
_MIN_ROBOT_PIXELS = 2000
_MIN_LASER_PIXELS = 100
_BACKGROUND = (0, 0, 255)
_ROBOT_GREY = range(60, 200)

_BOX = """<sdf version='1.6'><model name='wall'><static>true</static><pose>1.5 0 0.5 0 0 0</pose>
<link name='link'>
<collision name='c'><geometry><box><size>0.1 3 1</size></box></geometry></collision>
<visual name='v'><geometry><box><size>0.1 3 1</size></box></geometry></visual>
</link></model></sdf>"""

_VIEW = """
Panels: []
Visualization Manager:
  Displays:
    - {Class: rviz/RobotModel, Name: Robot, Enabled: true, Robot Description: robot_description}
    - {Class: rviz/LaserScan, Name: Laser, Enabled: true, Topic: /scan, Style: Points,
       Size (Pixels): 5, Color Transformer: FlatColor, Color: 255; 0; 0,
       Position Transformer: XYZ}
  Global Options: {Background Color: 0; 0; 255, Fixed Frame: odom, Frame Rate: 10}
  Views:
    Current: {Class: rviz/Orbit, Distance: 6, Focal Point: {X: 0.5, Y: 0, Z: 0},
              Pitch: 0.8, Yaw: 3.9}
Window Geometry: {Height: 700, Width: 900}
"""


def main(words: list[str]) -> int:
    """Print how many pixels show robot and laser; 1 when too few, 77 when something is missing."""
    missing = [name for name in ("rviz", "Xvfb", "import") if shutil.which(name) is None]
    if missing or not words:
        print(f"{__doc__}\nmissing: {', '.join(missing) or 'WORKSPACES'}", file=sys.stderr)
        return 77
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        picture = _picture(Path(words[0]), Path(folder), stack)
    if len(words) > 1:
        _save(picture, Path(words[1]))
    robot, laser = _robot_pixels(picture), _laser_pixels(picture)
    print(f"pixels of the robot: {robot} (at least {_MIN_ROBOT_PIXELS})")
    print(f"pixels of the laser: {laser} (at least {_MIN_LASER_PIXELS})")
    return int(robot < _MIN_ROBOT_PIXELS or laser < _MIN_LASER_PIXELS)


def _picture(workspaces: Path, folder: Path, stack: ExitStack) -> NDArray[np.uint8]:
    """Run the robot, the bridge and RViz; return the screen as soon as it shows both."""
    here = {"GAZELLE_PORT": str(_PORT), "ROS_MASTER_URI": _MASTER, "ROS_HOME": str(folder)}
    models = str(workspaces / "gazebo_models")
    gazelle = {**os.environ, **here, "GAZEBO_MODEL_PATH": models}
    command = [sys.executable, "-m", "gazelle.cli"]
    start = stack.enter_context
    catkin = workspaces / "catkin_ws"
    launch = [*command, "roslaunch", "slam_robot", "slam_robot_gazebo.launch"]
    start(_running(launch, gazelle, catkin))
    start(_running([*command, "bridge", "ros1"], gazelle, catkin))
    _spawn_wall(command, gazelle, folder)
    start(_running(["Xvfb", _DISPLAY, "-screen", "0", f"{_SIZE[0]}x{_SIZE[1]}x24"], {}, folder))
    (folder / "view.rviz").write_text(_VIEW)
    real = {
        "DISPLAY": _DISPLAY,
        "HOME": str(folder),
        "LIBGL_ALWAYS_SOFTWARE": "1",
        "PATH": "/usr/bin:/bin",
        "ROS_MASTER_URI": _MASTER,
        "ROS_PACKAGE_PATH": f"{catkin / 'src'}:/usr/share",
    }
    start(_running(["rviz", "-d", str(folder / "view.rviz")], real, folder))
    return _seen()


def _spawn_wall(command: list[str], environ: Mapping[str, str], folder: Path) -> None:
    (folder / "wall.sdf").write_text(_BOX)
    spawn = [*command, "spawn_model", "-sdf", "-file", str(folder / "wall.sdf"), "-model", "wall"]
    deadline = time.monotonic() + _PATIENCE_S
    while subprocess.run(spawn, env=environ, capture_output=True, check=False).returncode:
        if time.monotonic() > deadline:
            raise TimeoutError("the world did not take a wall")
        time.sleep(1.0)


def _seen() -> NDArray[np.uint8]:
    deadline = time.monotonic() + _PATIENCE_S
    time.sleep(_WARM_UP_S)
    while True:
        picture = _screen()
        enough = _robot_pixels(picture) >= _MIN_ROBOT_PIXELS
        if (enough and _laser_pixels(picture) >= _MIN_LASER_PIXELS) or (
            time.monotonic() > deadline
        ):
            return picture
        time.sleep(1.0)


def _screen() -> NDArray[np.uint8]:
    command = ["import", "-display", _DISPLAY, "-window", "root", "-depth", "8", "rgb:-"]
    data = subprocess.run(command, capture_output=True, check=True).stdout
    return np.frombuffer(data, np.uint8).reshape(_SIZE[1], _SIZE[0], 3)


def _view_of(picture: NDArray[np.uint8]) -> NDArray[np.int64]:
    """The part of the screen where RViz draws: what its background surrounds."""
    rows, columns = np.nonzero((picture == _BACKGROUND).all(axis=2))
    if not rows.size:
        return np.zeros((0, 0, 3), np.int64)
    part = picture[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]
    return part.astype(np.int64)


def _robot_pixels(picture: NDArray[np.uint8]) -> int:
    view = _view_of(picture)
    if not view.size:
        return 0
    flat = view.max(axis=2) - view.min(axis=2) < 20
    return int((flat & np.isin(view[..., 0], _ROBOT_GREY)).sum())


def _laser_pixels(picture: NDArray[np.uint8]) -> int:
    view = _view_of(picture)
    return int((view == (255, 0, 0)).all(axis=2).sum()) if view.size else 0


def _save(picture: NDArray[np.uint8], path: Path) -> None:
    command = ["convert", "-size", f"{_SIZE[0]}x{_SIZE[1]}", "-depth", "8", "rgb:-", str(path)]
    subprocess.run(command, input=picture.tobytes(), check=True)


@contextmanager
def _running(command: list[str], environ: Mapping[str, str], cwd: Path) -> Iterator[None]:
    """Run a program; end it and all it has started."""
    with subprocess.Popen(
        command, env=environ or None, cwd=cwd, start_new_session=True,
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    ) as process:  # fmt: skip
        try:
            yield
        finally:
            os.killpg(process.pid, signal.SIGINT)
            try:
                process.wait(_PATIENCE_S)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
