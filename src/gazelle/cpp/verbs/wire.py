"""Verbs of how messages lie in bytes, for C++ that has no class of them.

``wire/type`` gives a message and all it contains by their names, each with the order of its
fields in CDR and in ROS 1's bytes::

    {"cdr": [slot…], "ros1": [slot…], "definition": …, "md5": …}

A slot has ``name`` (empty where the other bytes lack it), ``size`` of a number (0 of text and
messages), ``repeat`` (one, fixed, sequence), ``count`` and, of a message, ``type``.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.errors import InterfaceError, NotFoundError

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext
    from gazelle.interfaces import TypeStore
    from gazelle.interfaces.wire_layout import Layout, Slot

__all__: list[str] = []

_STORE = "wire/types"


@verb("wire/type")
def wire_type(host: HostContext, request: dict[str, Any]) -> dict[str, Any]:
    """Return how a message's bytes lie; its ``definition`` says what nobody knows here."""
    from gazelle.interfaces import RosVersion
    from gazelle.interfaces.wire_layout import Wire, bind

    name, types = request["type"], _types(host, request["type"], request.get("definition", ""))
    found: dict[str, Any] = {}

    def describe(layout: Layout) -> None:
        if layout.name in found:
            return
        described: dict[str, Any] = {"cdr": [], "ros1": [], "definition": "", "md5": ""}
        found[layout.name] = described
        if layout.name.startswith("builtin_interfaces/"):
            described["cdr"] = described["ros1"] = [_slot(slot) for slot in layout.slots]
            return
        for key, wire in (("cdr", Wire.CDR), ("ros1", Wire.ROS1)):
            try:
                own = bind(types, layout.name, RosVersion.ROS1, wire)
            except NotFoundError:
                # Only ROS 2 has it: it is in a field that ROS 1's message lacks.
                own = layout
            described[key] = [_slot(slot) for slot in own.slots]
            for slot in own.slots:
                if slot.child is not None:
                    describe(slot.child)

    describe(bind(types, name, RosVersion.ROS1, Wire.ROS1))
    own = found[name]
    own["definition"], own["md5"] = types.ros1_definition(name), types.md5sum(name)
    return found


def _types(host: HostContext, name: str, definition: str) -> TypeStore:
    """Return where the type is known: here, or as the program's own text says."""
    from gazelle.bag import Connection, Encoding, learn_definitions
    from gazelle.interfaces import TypeStore, default_types

    types = default_types()
    if types.exists(name) or not definition:
        return types
    kept: dict[str, TypeStore] = host.state.setdefault(_STORE, {})
    store = kept.get(definition)
    if store is None:
        store = kept[definition] = TypeStore(types)
        learn_definitions([Connection(0, "", name, Encoding.ROS1, definition, "*")], store)
    return store


def _slot(slot: Slot) -> dict[str, Any]:
    if slot.base == "wstring":
        raise InterfaceError("wide strings cannot be passed on without their class")
    row: dict[str, Any] = {
        "name": slot.attribute or "",
        "size": struct.calcsize(slot.letter) if slot.letter else 0,
        "repeat": slot.array.value,
        "count": slot.size,
    }
    if slot.child is not None:
        row["type"] = slot.child.name
        row["size"] = 0
    return row
