"""Schemas that others read."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from gazelle.bridge.foxglove.channels import SchemaBook
from gazelle.interfaces import known_types, message_type, to_cdr

pytestmark = pytest.mark.reference


PACKAGES = (
    "gazebo_msgs", "nav_msgs", "rcl_interfaces", "rosgraph_msgs", "sensor_msgs", "tf2_msgs",
    "trajectory_msgs", "visualization_msgs",
)  # fmt: skip


@pytest.mark.parametrize("package", PACKAGES)
def test_rosbags_reads_messages_by_their_schemas(package: str) -> None:
    said: list[str] = []
    book = SchemaBook(said.append)
    names = known_types("msg", package)
    assert names
    for full in names:
        schema = book.message(full, "a topic")
        assert schema is not None, said
        store = get_typestore(Stores.EMPTY)
        store.register(get_types_from_msg(schema, full))
        message = message_type(full)()
        assert type(store.deserialize_cdr(to_cdr(message), full)).__name__ == full.replace(
            "/", "__"
        )


def test_unknown_type_is_told_once() -> None:
    said: list[str] = []
    book = SchemaBook(said.append)
    assert [book.message("nowhere/msg/X", f"topic {name}") for name in "ab"] == [None, None]
    assert len(said) == 1
    assert said[0].startswith("topic a is not shown: nothing here defines its type nowhere/msg/X")
