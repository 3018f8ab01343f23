# ruff: noqa: E501  (a row of the table is one line)
"""Lay out the packages of ``test_more.py``, each at the commit at which its facts were found.

    lay_out.py --out DIR [--mirror MIRROR] [--only M01,M02]

With --mirror, files come from bare repositories named ``MIRROR/owner+name/repo``; without it, each
repository is cloned from GitHub. Nothing is built. A folder is one package as its README has one
set it up: ``DIR/M01/ws/src/stretch_ros/…``; files that a mirror lacks, or that are too large, are
named in its MISSING.txt.
"""

from __future__ import annotations

import argparse
import fnmatch
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

MAX_BYTES = 8_000_000
"""Files above this are not laid out: videos, bags, textures."""


class Source(NamedTuple):
    """A folder of a repository, and where it goes.

    Attributes:
        package: the folder that it is for.
        repository: its ``owner/name`` on GitHub.
        commit: the full name of the commit.
        path: the folder in the repository, ``.`` for all of it.
        to: where it goes, under ``ws/src``.
        skip: globs of paths, relative to `path`, that are left out.
    """

    package: str
    repository: str
    commit: str
    path: str
    to: str
    skip: tuple[str, ...] = ()


_MEDIA = ("*.gif", "*.mp4", "*.zip", "*.bag", "*.pdf")
_BOOK = "qboticslabs/mastering_ros"
_BOOK_AT = "d83e78f30acc45b0f18522c1d5fae3a7f52974b9"
_COURSE = "AntoBrandi/Self-Driving-and-ROS-2-Learn-by-Doing-Odometry-Control"
_UR = "UniversalRobots/Universal_Robots_ROS2_"

SOURCES = [
    Source("M01", "hello-robot/stretch_ros", "63043d8a62942221aa3abb45308977cb90c7c13d", ".", "stretch_ros", _MEDIA),
    Source("M01", "IntelRealSense/realsense-ros", "b14ce433d1cccd2dfb1ab316c0ff1715e16ab961", "realsense2_description", "realsense2_description"),
    Source("M02", "ZebraDevs/fetch_gazebo", "37b38fd824f5c7fe728e76f46a669c9e4b11197f", ".", "fetch_gazebo", _MEDIA),
    Source("M02", "ZebraDevs/fetch_ros", "42b4d8199abbfab04aceea28a0ea4c9dab54667a", ".", "fetch_ros", _MEDIA),
    Source("M03", "ros-industrial/kuka_experimental", "e78bbd15edb2b39c9053ff3b963ef2947e10a531", ".", "kuka_experimental"),
    Source("M04", "ros-industrial/abb", "77db19bdb098f50d9569d1cab03ee657627e934e", ".", "abb"),
    Source("M05", "xArm-Developer/xarm_ros", "0b5118eb6bf664fc3891c14b203e6ecbd5095dca", ".", "xarm_ros", _MEDIA),
    Source("M06", "NiryoRobotics/ned_ros", "f5489e4e1b73b646d22b1fa49c988f9b2e3d970a", ".", "ned_ros", (*_MEDIA, "docs/*")),
    Source("M07", "DFKI-NI/mir_robot", "a82951afcf1f884cdbd5963cc18d597f5d9be39a", ".", "mir_robot", _MEDIA),
    Source("M08", "LeoRover/leo_simulator", "ed52d5ac8d1aa43d80cc87ca60dbfd4055e07760", ".", "leo_simulator"),
    Source("M08", "LeoRover/leo_common", "98c0b0f1a3e6f32770176fd2ca1f78541c238f49", ".", "leo_common"),
    Source("M09", "mit-racecar/racecar_gazebo", "effd29f9edc20a03c8a1f666fb6fb6c0cbbee8ff", ".", "racecar_gazebo", _MEDIA),
    Source("M09", "mit-racecar/racecar", "b464bf1f85341037087c7dcc0ff75c0671c26d97", ".", "racecar"),
    Source("M10", "tu-darmstadt-ros-pkg/hector_quadrotor", "9ba44416b905f123b271d9ed64d5a4f0df433df0", ".", "hector_quadrotor"),
    Source("M10", "tu-darmstadt-ros-pkg/hector_models", "7a9892d0b9465e5ee121bf2865645c0b75faf1d9", ".", "hector_models"),
    Source("M11", "aws-robotics/aws-robomaker-hospital-world", "39969a9d250135835cf13b480865647d1a87b6f4", ".", "aws_robomaker_hospital_world", _MEDIA),
    Source("M12", "ridgeback/ridgeback", "f38b7897cb3e56b1d49da9b196c28a6fc1de3e2d", ".", "ridgeback"),
    Source("M12", "ridgeback/ridgeback_simulator", "86ef7cb0130a0380aee07ce2728776d535dbc124", ".", "ridgeback_simulator"),
    Source("M12", "clearpathrobotics/LMS1xx", "d80907e539d72a373002e9d68e4b982eb4b6d7ce", ".", "lms1xx"),
    Source("M13", _BOOK, _BOOK_AT, "chapter_2_codes", "chapter_2_codes"),
    Source("M13", _BOOK, _BOOK_AT, "chapter_4_codes", "chapter_4_codes"),
    Source("M14", "agilexrobotics/ugv_gazebo_sim", "59d88af56f63c0000890b38199c111f6cbb9154e", ".", "ugv_gazebo_sim", _MEDIA),
    Source("M15", "ros/ros_tutorials", "db6328879831b4abadac939bd69b43133414c0db", ".", "ros_tutorials"),
    Source("M16", "Kinovarobotics/ros_kortex", "6cd75d45f4d00413d73fe2af96f4d0c7d8f234be", ".", "ros_kortex", _MEDIA),
    Source("M17", "xArm-Developer/xarm_ros2", "5109131e7870c7d6e1075042d531e659d072cdb0", ".", "xarm_ros2", _MEDIA),
    Source("M18", "ROBOTIS-GIT/open_manipulator", "3fd6fa94727f863deec52d4f461f39a5fe4d2b10", ".", "open_manipulator", _MEDIA),
    Source("M19", "linorobot/linorobot2", "1981a12021388d41d8ee28f7ee918f1ecccc1702", ".", "linorobot2", _MEDIA),
    Source("M20", "husarion/rosbot_ros", "5b024d75db0d03b132d1577e52c35ff065c9bdc4", ".", "rosbot_ros", _MEDIA),
    Source("M20", "husarion/husarion_office_gz", "6049a8f25baac7329b911fcddd080c57bcc1c4f2", ".", "husarion_office_gz", _MEDIA),
    Source("M20", "husarion/ros_components_description", "2a669a02582d89dbe0c5699381f096a3f7a51815", ".", "ros_components_description"),
    Source("M21", "NovoG93/sjtu_drone", "4a643e22d7cb0400c69eb0a62c689655d481b4db", ".", "sjtu_drone", _MEDIA),
    Source("M22", _UR + "GZ_Simulation", "54a6a11a88b886f886cfa098bb21bf8448ea8c18", ".", "ur_simulation_gz", _MEDIA),
    Source("M22", _UR + "Description", "2221ec0f720fb1af99339eb891639b499b62f1da", ".", "ur_description"),
    Source("M23", _UR + "Gazebo_Simulation", "1de0dc4e9615832219f22f0f86cd0a9e8bcc356b", ".", "ur_simulation_gazebo", _MEDIA),
    Source("M23", _UR + "Description", "990270f398dcd56f016360f2cf3c84dbac9c48fa", ".", "ur_description"),
    Source("M24", "ros-navigation/navigation2_tutorials", "1432585db32227ce9bc9103010e684fe979f2796", ".", "navigation2_tutorials", _MEDIA),
    Source("M25", "gazebosim/ros_gz_project_template", "55bea9ee564be6ac4ce76650abab3aa2ed18e0ee", ".", "ros_gz_project_template"),
    Source("M26", "turtlebot/turtlebot4_simulator", "a238c9456dd9b0cb6476177e0abcb94f810121ef", ".", "turtlebot4_simulator"),
    Source("M26", "turtlebot/turtlebot4", "d6881758863264ca32cf2a965c2a0ddfb2cc3094", ".", "turtlebot4"),
    Source("M26", "iRobotEducation/create3_sim", "6a8bc44f9be2c260bc17e753c31455d6759af238", ".", "create3_sim"),
    Source("M26", "turtlebot/turtlebot4_desktop", "149d973cfefbcaefa1d2a918239fcfc7c3722123", ".", "turtlebot4_desktop"),
    Source("M27", "neobotix/neo_simulation2", "27b1f2ca3dc61eb137c51ba0d635fd1eb9cbac8e", ".", "neo_simulation2", _MEDIA),
    Source("M28", "MOGI-ROS/Week-3-4-Gazebo-basics", "247330ea7c1165cde8766cb9bc79e6005168af73", ".", "Week-3-4-Gazebo-basics", _MEDIA),
    Source("M28", "MOGI-ROS/mogi_trajectory_server", "9dbbfc47a1fde3b6f9eccca18b9f5675b0c94637", ".", "mogi_trajectory_server"),
    Source("M29", "automaticaddison/yahboom_rosmaster", "b0e7b5ccfdadc68c4c150f91aba38fadbfc570ed", ".", "yahboom_rosmaster", _MEDIA),
    Source("M30", "ros2/demos", "a9f237b30ee98ff1b33fd67323517a2c62506925", ".", "demos", _MEDIA),
    Source("M32", "aws-robotics/aws-robomaker-bookstore-world", "f5a2aaacd5418f9ecfa30f79e788856417f17c13", ".", "aws_robomaker_bookstore_world", _MEDIA),
    Source("M34", _COURSE, "35d59db59b53cd2fa61e09de8215f43cf5c9e30c", "Section11_Sensor_Fusion/bumperbot_ws/src", ".", _MEDIA),
]  # fmt: skip


class _Blob(NamedTuple):
    mode: str
    name: str
    size: str
    path: str


def _git(repository: Path, *words: str) -> bytes:
    # A partial snapshot must not be completed over the network: what it lacks is named.
    environment = {**os.environ, "GIT_NO_LAZY_FETCH": "1", "GIT_TERMINAL_PROMPT": "0"}
    command = ["git", f"--git-dir={repository}", *words]
    return subprocess.run(command, env=environment, check=True, capture_output=True).stdout


def _blobs(repository: Path, source: Source) -> Iterator[_Blob]:
    """Yield the files of a source, with paths relative to it."""
    place = [] if source.path == "." else ["--", source.path]
    listed = _git(repository, "ls-tree", "-r", "-l", "-z", source.commit, *place)
    for record in listed.split(b"\0"):
        if not record:
            continue
        about, _, raw = record.partition(b"\t")
        mode, kind, name, size = about.decode().split()
        path = os.fsdecode(raw)
        if source.path != ".":
            path = os.path.relpath(path, source.path)
        if kind == "blob" and not any(fnmatch.fnmatch(path, glob) for glob in source.skip):
            yield _Blob(mode, name, size, path)


def _write(blob: _Blob, data: bytes, to: Path) -> None:
    to.parent.mkdir(parents=True, exist_ok=True)
    if blob.mode == "120000":
        to.symlink_to(os.fsdecode(data))
        return
    to.write_bytes(data)
    if blob.mode == "100755":
        to.chmod(0o755)


def lay_out(repository: Path, source: Source, folder: Path) -> tuple[int, list[str]]:
    """Write a source's files into a package's folder.

    Args:
        repository: the git directory.
        source: what is wanted of it.
        folder: the package's.

    Returns:
        How many files were written, and the paths of those that are missing.
    """
    written, missing = 0, []
    base = folder / "ws" / "src" / source.to
    reader = subprocess.Popen(
        ["git", f"--git-dir={repository}", "cat-file", "--batch"],
        env={**os.environ, "GIT_NO_LAZY_FETCH": "1"},
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    assert reader.stdin is not None and reader.stdout is not None
    for blob in _blobs(repository, source):
        # "BAD" is what git says of a blob that the snapshot has the name of only.
        if not blob.size.isdigit() or int(blob.size) > MAX_BYTES:
            missing.append(blob.path)
            continue
        reader.stdin.write(f"{blob.name}\n".encode())
        reader.stdin.flush()
        head = reader.stdout.readline().split()
        if len(head) != 3:
            missing.append(blob.path)
            continue
        data = reader.stdout.read(int(head[2]))
        reader.stdout.read(1)
        to = base / blob.path
        if ".." in to.relative_to(folder).parts:
            missing.append(blob.path)
            continue
        _write(blob, data, to)
        written += 1
    reader.stdin.close()
    reader.wait()
    return written, missing


def _from_mirror(mirror: Path, name: str) -> Path:
    repository = mirror / name.replace("/", "+") / "repo"
    inner = repository / ".git"
    return inner if inner.is_dir() else repository


def _cloned(clones: Path, source: Source) -> Path:
    repository = clones / source.repository.replace("/", "+")
    if not repository.is_dir():
        subprocess.run(["git", "init", "-q", "--bare", str(repository)], check=True)
    url = f"https://github.com/{source.repository}"
    _git(repository, "fetch", "-q", "--depth", "1", url, source.commit)
    return repository


def main(words: list[str] | None = None) -> int:
    """Lay out what is asked for; the exit code tells whether all of it came."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--out", type=Path, required=True, help="the folder of all packages")
    parser.add_argument("--mirror", type=Path, help="where bare repositories are")
    parser.add_argument("--only", default="", help="a comma between packages")
    asked = parser.parse_args(words)
    only = {one for one in asked.only.split(",") if one}
    failed = False
    with tempfile.TemporaryDirectory() as clones:
        for package in dict.fromkeys(source.package for source in SOURCES):
            if only and package not in only:
                continue
            folder = asked.out.resolve() / package
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            total, missing = 0, []
            for source in SOURCES:
                if source.package != package:
                    continue
                try:
                    repository = (
                        _from_mirror(asked.mirror, source.repository)
                        if asked.mirror
                        else _cloned(Path(clones), source)
                    )
                    written, lacking = lay_out(repository, source, folder)
                except (subprocess.CalledProcessError, OSError) as error:
                    detail = getattr(error, "stderr", b"") or b""
                    print(f"{package}: {source.repository}: {error} {detail.decode()}")
                    failed = True
                    continue
                total += written
                missing += [f"{source.repository}: {path}" for path in lacking]
            if missing:
                (folder / "MISSING.txt").write_text("\n".join(missing) + "\n", encoding="utf-8")
            print(f"{package}  {total:5} files, {len(missing)} missing")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
