"""Texts of definitions from the process that brought messages in to the one that records them.

A bridge and a player know the text that a message's type came with. They answer for it on the
graph; who writes connections of ROS 1 asks once for each type.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gazelle.bag.storage import Connection, Encoding
from gazelle.bag.types import learn_definitions
from gazelle.errors import GazelleError
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.interfaces import RosVersion, TypeStore, default_types, keep_text

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["TextShare", "fetch_text"]

# Whoever answers does it at once, unless its machine has much to do; without the text a type that
# only its sender knows is not recorded.
_ASK_S = 10.0
_ANY = "*"
_KEY = "@gazelle/{}/definition/{}"  # 1/pkg/Name/MD5 or 2/pkg/Name/HASH


class TextShare:
    """Answers with the texts that came into this process."""

    def __init__(self, graph: Graph, stores: Sequence[TypeStore] = ()) -> None:
        """Start to answer.

        Args:
            graph: who may ask.
            stores: have the texts, the first that knows a type answers; the process's own when
                empty.
        """
        import zenoh

        self._stores = stores or (default_types(),)
        self._callback_queue = CallbackQueue(self._answer, size=0, name="definition texts")
        # Direct: zenoh's own callback threads would keep a process from ending.
        callback = zenoh.handlers.Callback(self._callback_queue.put, None, indirect=False)
        key = _KEY.format(graph.domain, "**")
        self._queryable: Any = graph.session.declare_queryable(key, callback)

    def close(self) -> None:
        """Answer no more."""
        self._queryable.undeclare()
        self._callback_queue.close()

    def _answer(self, query: Any) -> None:
        start, _, rest = str(query.key_expr).rpartition("/definition/")
        words = rest.split("/")
        if len(words) == 4 and words[0] in ("1", "2"):
            ros_version, name = RosVersion(int(words[0])), f"{words[1]}/{words[2]}"
            for types in self._stores:
                text, meaning = (
                    types.kept_text(name, ros_version),
                    _meaning(types, name, ros_version),
                )
                if text and words[3] in (meaning, _ANY):
                    key = f"{start}/definition/{words[0]}/{name}/{meaning}"
                    query.reply(key, text.encode())
                    break
        query.drop()


def fetch_text(graph: Graph, name: str, ros_version: RosVersion) -> None:
    """Keep the text that another process has of a type, or learn the type from it.

    Nothing happens when no process has one; what is known here counts then.

    Args:
        graph: where to ask.
        name: ``pkg/Name``.
        ros_version: whose text.
    """
    meaning = _meaning(default_types(), name, ros_version)
    key = _KEY.format(graph.domain, f"{int(ros_version)}/{name}/{meaning or _ANY}")
    for reply in graph.session.get(key, timeout=_ASK_S):
        if reply.ok is None:
            continue
        text = reply.ok.payload.to_bytes().decode("utf-8", "replace")
        if not meaning:
            found = str(reply.ok.key_expr).rpartition("/")[2]
            learn_definitions([Connection(0, "", name, _ENCODINGS[ros_version], text, found)])
        if keep_text(name, ros_version, text):
            return


_ENCODINGS = {RosVersion.ROS1: Encoding.ROS1, RosVersion.ROS2: Encoding.CDR}


def _meaning(types: TypeStore, name: str, ros_version: RosVersion) -> str:
    try:
        return types.md5sum(name) if ros_version is RosVersion.ROS1 else types.type_hash(name)
    except GazelleError:
        return ""
