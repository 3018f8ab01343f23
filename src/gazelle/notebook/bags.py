"""Open bags: what is in them."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

from gazelle.notebook.html_parts import figure, table
from gazelle.rich_display import Bundle

if TYPE_CHECKING:
    from gazelle.bag.storage import BagMessage, BagReader

__all__ = ["bag_bundle", "bag_message_bundle"]


def bag_bundle(bag: BagReader) -> Bundle:
    """Return the topics of a bag with their types and numbers of messages."""
    summary = bag.summary
    seconds = summary.duration_ns * 1e-9
    rows: dict[tuple[str, str], int] = {}
    for one in bag.connections:
        key = (one.topic, one.type_name)
        rows[key] = rows.get(key, 0) + summary.counts.get(one.id, 0)
    shown = table(
        ("topic", "type", "messages", "Hz"),
        [
            (topic, type_name, count, f"{count / seconds:.3g}" if seconds > 0 else "")
            for (topic, type_name), count in sorted(rows.items())
        ],
    )
    begin = datetime.fromtimestamp(summary.start_ns * 1e-9, UTC)
    words = [
        f"{bag.path.name} ({bag.storage}): {summary.messages} messages, {seconds:.2f} s, "
        f"{summary.size / 1e6:.2f} MB",
        f"from {begin:%Y-%m-%d %H:%M:%S} UTC" if summary.messages else "",
        "" if summary.is_indexed else "it was not closed",
    ]
    return {"text/html": figure(shown, ", ".join(word for word in words if word))}


def bag_message_bundle(message: BagMessage) -> Bundle:
    """Return a message of a bag, decoded."""
    from gazelle.bag.storage import Encoding
    from gazelle.bag.types import bag_types, message_class
    from gazelle.interfaces import from_cdr, from_ros1
    from gazelle.notebook.messages import message_bundle

    types = bag_types((message.connection,)).store
    read = from_ros1 if message.connection.encoding is Encoding.ROS1 else from_cdr
    decoded = read(message_class(message.connection, types), message.data)
    return message_bundle(decoded)
