"""Codecs against rosbags: bytes of common messages written and read, and cost of the start.

Run it as ``python benchmarks/bench_codecs.py``. Each figure is the best of several rounds.
The rows "view" are classes of ROS 1, whose arrays are tuples of Python numbers as in rospy; the
peer has numpy arrays there too.
"""

from __future__ import annotations

import subprocess
import sys
import timeit
from collections.abc import Callable
from functools import partial

import numpy as np
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from gazelle.interfaces import (
    Message,
    from_cdr,
    from_ros1,
    message_type,
    ros1_message_type,
    to_cdr,
    to_ros1,
)

Call = Callable[[], object]

_ROUNDS = 7
_TF = "tf2_msgs/msg/TFMessage"


def main() -> None:
    store2, store1 = get_typestore(Stores.ROS2_JAZZY), get_typestore(Stores.ROS1_NOETIC)
    store1.register(get_types_from_msg("geometry_msgs/TransformStamped[] transforms", _TF))
    print(f"{'µs each':<14}{'':<12}{'gazelle':>10}{'rosbags':>10}{'ratio':>8}")
    for name, message in _messages().items():
        for label, ours, theirs in _pairs(message, store2, store1):
            mine, other = _best(ours), _best(theirs)
            print(f"{name:<14}{label:<12}{mine:>10.2f}{other:>10.2f}{mine / other:>8.2f}")
    _start_up()


def _pairs(message: Message, store2: Typestore, store1: Typestore) -> list[tuple[str, Call, Call]]:
    cls, full = type(message), message.TYPE_NAME
    cdr, ros1 = to_cdr(message), to_ros1(message)
    peer2, peer1 = store2.deserialize_cdr(cdr, full), store1.deserialize_ros1(ros1, full)
    view_class = ros1_message_type(full)
    view = from_ros1(view_class, ros1)
    write2 = partial(store2.serialize_cdr, peer2, full)
    read2 = partial(store2.deserialize_cdr, cdr, full)
    write1 = partial(store1.serialize_ros1, peer1, full)
    read1 = partial(store1.deserialize_ros1, ros1, full)
    return [
        ("write CDR", partial(to_cdr, message), write2),
        ("read CDR", partial(from_cdr, cls, cdr), read2),
        ("write ROS 1", partial(to_ros1, message), write1),
        ("read ROS 1", partial(from_ros1, cls, ros1), read1),
        ("view → CDR", partial(to_cdr, view), write2),
        ("CDR → view", partial(from_cdr, view_class, cdr), read2),
    ]


def _messages() -> dict[str, Message]:
    rng = np.random.default_rng(1)
    header = message_type("std_msgs/Header")
    transform = message_type("geometry_msgs/TransformStamped")
    field = message_type("sensor_msgs/PointField")

    def stamped() -> Message:
        found = header(frame_id="base_footprint")
        found.stamp.sec, found.stamp.nanosec = 12, 345
        return found

    joints = [f"joint_{index}" for index in range(7)]
    points = rng.integers(0, 255, 640 * 480 * 16, dtype=np.uint8)
    names = zip("xyz", (0, 4, 8), strict=True)
    return {
        "JointState": message_type("sensor_msgs/JointState")(
            stamped(), joints, rng.random(7), rng.random(7), rng.random(7)
        ),
        "LaserScan": message_type("sensor_msgs/LaserScan")(
            stamped(), ranges=rng.random(360, np.float32), intensities=rng.random(360, np.float32)
        ),
        "Odometry": message_type("nav_msgs/Odometry")(stamped(), "base_link"),
        "TFMessage": message_type("tf2_msgs/TFMessage")(
            [transform(stamped(), f"link_{index}") for index in range(5)]
        ),
        "Image": message_type("sensor_msgs/Image")(
            stamped(), 480, 640, "rgb8", 0, 1920, rng.integers(0, 255, 921600, dtype=np.uint8)
        ),
        "PointCloud2": message_type("sensor_msgs/PointCloud2")(
            stamped(), 480, 640, [field(n, at, 7, 1) for n, at in names], False, 16, 10240, points
        ),
        "Twist": message_type("geometry_msgs/Twist")(),
    }


def _best(call: Call) -> float:
    timer = timeit.Timer(call)
    count = max(1, timer.autorange()[0] // 8)
    return min(timer.repeat(_ROUNDS, count)) / count * 1e6


def _start_up() -> None:
    code = """
import numpy, time
start = time.perf_counter()
import gazelle.interfaces as i
print(f"import gazelle.interfaces {(time.perf_counter() - start) * 1e3:.1f} ms")
for name in ("sensor_msgs/LaserScan", "tf2_msgs/TFMessage"):
    for form in (i.message_type, i.ros1_message_type):
        start = time.perf_counter()
        cls = form(name)
        i.from_cdr(cls, i.to_cdr(cls()))
        print(f"first use of {name} ({form.__name__}) {(time.perf_counter() - start) * 1e3:.1f} ms")
"""
    command = [sys.executable, "-c", code]
    print(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


if __name__ == "__main__":
    main()
