from __future__ import annotations

import pytest

from gazelle.errors import NotFoundError
from gazelle.interfaces import type_hash

PUBLISHED = {
    "builtin_interfaces/msg/Time": (
        "b106235e25a4c5ed35098aa0a61a3ee9c9b18d197f398b0e4206cea9acf9c197"
    ),
    "geometry_msgs/msg/Point": ("6963084842a9b04494d6b2941d11444708d892da2f4b09843b9c43f42a7f6881"),
    "nav_msgs/msg/OccupancyGrid": (
        "8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7"
    ),
    "nav_msgs/srv/SetMap": ("5e11a5b2ca53d8ae85b666a019f16c9904ebc787828f1f566c4e048a1ddedfb4"),
    "nav_msgs/srv/SetMap_Event": (
        "68371c7e20b5f04c60581c63c676a033f4530beb507dbb88732cdd5750d60d7f"
    ),
    "lifecycle_msgs/srv/ChangeState": (
        "356fe34f0475a43acf54542013af4167b0e729f77ea22ffb045c6ad8e20668e5"
    ),
    "std_msgs/msg/Char": ("3ad2d04dd29ba19d04b16659afa3ccaedd691914b02a64e82e252f2fa6a586a9"),
    "service_msgs/msg/ServiceEventInfo": (
        "41bcbbe07a75c9b52bc96bfd5c24d7f0fc0a08c0cb7921b3373c5732345a6f45"
    ),
}


@pytest.mark.parametrize(("name", "digest"), PUBLISHED.items())
def test_hashes_are_those_that_ros2_publishes(name, digest):
    assert type_hash(name) == f"RIHS01_{digest}"


def test_action_hash_covers_its_services():
    assert type_hash("example_interfaces/Fibonacci", "action").startswith("RIHS01_")
    assert type_hash("example_interfaces/action/Fibonacci") != type_hash(
        "example_interfaces/action/Fibonacci_SendGoal"
    )


def test_unknown_type_has_no_hash():
    with pytest.raises(NotFoundError, match="did you mean 'std_msgs/msg/String'"):
        type_hash("std_msgs/Strin")
