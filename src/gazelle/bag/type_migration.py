"""Messages of a bag in the types of this machine, where those have changed since.

The rule is that of ``rosbag fix`` without rule files: a type is brought over when it has the same
fields, in whatever order, with values of the same kind, and no constant has changed or gone.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.bag.storage import BagError, Connection
from gazelle.bag.types import split_texts
from gazelle.errors import GazelleError
from gazelle.interfaces import (
    Definition,
    Field,
    RosVersion,
    TypeStore,
    default_types,
    definition,
    from_ros1,
    md5sum,
    ros1_message_type,
    to_ros1,
)
from gazelle.interfaces.definition import Array, attribute_name
from gazelle.interfaces.parser import parse_message
from gazelle.interfaces.ros1_conversion import definition_text
from gazelle.interfaces.type_names import ros1_name, split_name

__all__ = ["Change", "Migration", "migration_of"]

_Carry = Callable[[Any], Any]


class Change(NamedTuple):
    """A type that the bag and this machine define differently.

    Attributes:
        type_name: ``pkg/Name``.
        bag_sum, own_sum: MD5 sums; the second is empty when the type is not known here.
        problems: why it cannot be brought over; empty when it can.
    """

    type_name: str
    bag_sum: str
    own_sum: str
    problems: tuple[str, ...]


class Migration(NamedTuple):
    """What has to happen to the messages of a type.

    Attributes:
        changes: the type itself, then those it contains, each once.
        convert: from the bag's bytes to this machine's; None when a change has problems.
    """

    changes: tuple[Change, ...]
    convert: Callable[[bytes], bytes] | None

    @property
    def missing(self) -> tuple[Change, ...]:
        """Changes that stand in the way."""
        return tuple(one for one in self.changes if one.problems)


def migration_of(one: Connection) -> Migration | None:
    """Return what has to happen to a connection's messages, None when nothing has to.

    Raises:
        BagError: the bag's definition cannot be read.
    """
    full = "/".join(split_name(one.type_name))
    try:
        if md5sum(full) == one.md5sum:
            return None
    except GazelleError:
        text = "the type is not known here"
        return Migration((Change(one.type_name, one.md5sum, "", (text,)),), None)
    bag = _BagTypes(full, one)
    changes: dict[str, Change] = {}
    bag.compare(full, changes)
    found = tuple(changes.values())
    if any(change.problems for change in found):
        return Migration(found, None)
    view, carry = bag.store().ros1_message_type(full), bag.carry(full)
    return Migration(found, lambda data: to_ros1(carry(from_ros1(view, data))))


class _BagTypes:
    """The types that a connection's definition defines."""

    def __init__(self, name: str, one: Connection) -> None:
        self._root, self._root_sum = name, one.md5sum
        self._types: dict[str, Definition] = {}
        for part, text in split_texts(one):
            full = "/".join(split_name(part))
            try:
                parsed = parse_message(text, full, RosVersion.ROS1, diagnostics=None)
            except GazelleError as error:
                raise BagError(f"the bag's definition of {part} cannot be read: {error}") from None
            self._types[full] = parsed

    def compare(self, name: str, changes: dict[str, Change]) -> None:
        """Add the changes of a type and of all that it contains."""
        bag_sum, short = self._sum(name), ros1_name(name)
        if name in changes:
            return
        try:
            own, own_sum = definition(name, RosVersion.ROS1), md5sum(name)
        except GazelleError:
            changes[name] = Change(short, bag_sum, "", ("the type is not known here",))
            return
        if own_sum == bag_sum:
            return
        theirs = {item.name: item for item in self._types[name].fields}
        mine = {item.name: item for item in own.fields}
        problems = [f"field '{key}' is not in the bag" for key in mine if key not in theirs]
        problems += [f"field '{key}' is only in the bag" for key in theirs if key not in mine]
        shared = [(theirs[key], mine[key]) for key in mine if key in theirs]
        problems += [text for pair in shared if (text := _difference(*pair))]
        gone = set(self._types[name].constants) - set(own.constants)
        problems += sorted(f"constant '{item.name}' has changed or gone" for item in gone)
        changes[name] = Change(short, bag_sum, own_sum, tuple(problems))
        for item, _ in shared:
            if item.type.is_message and item.type.base in self._types:
                self.compare(item.type.base, changes)

    def store(self) -> TypeStore:
        """Return a store that reads the bag's form of those that have changed."""
        store = TypeStore(below=default_types())
        for name, source in self._types.items():
            if self._is_changed(name):
                text = definition_text(source.constants, source.fields, RosVersion.ROS1)
                store.add_text(name, RosVersion.ROS1, text + "\n")
        return store

    def carry(self, name: str) -> _Carry:
        """Return the function from the bag's form of a message to this machine's."""
        own = ros1_message_type(name)
        steps = [self._step(item) for item in self._types[name].fields]

        def carry(old: Any) -> Any:
            new: Any = own()
            for attribute, convert in steps:
                value = getattr(old, attribute)
                setattr(new, attribute, value if convert is None else convert(value))
            return new

        return carry

    def _step(self, item: Field) -> tuple[str, _Carry | None]:
        attribute = attribute_name(item.name)
        if not item.type.is_message or not self._is_changed(item.type.base):
            return attribute, None
        one = self.carry(item.type.base)
        if item.type.array is Array.ONE:
            return attribute, one
        return attribute, lambda values: [one(value) for value in values]

    def _is_changed(self, name: str) -> bool:
        return name in self._types and self._sum(name) != md5sum(name)

    def _sum(self, name: str) -> str:
        if name == self._root:
            return self._root_sum
        if name not in self._types:
            return md5sum(name)
        source = self._types[name]
        lines = [f"{item.type} {item.name}={item.text}" for item in source.constants]
        for item in source.fields:
            kind = item.type
            word = self._sum(kind.base) if kind.is_message else kind.text(RosVersion.ROS1)
            lines.append(f"{word} {item.name}")
        return hashlib.md5("\n".join(lines).encode(), usedforsecurity=False).hexdigest()


def _difference(theirs: Field, mine: Field) -> str:
    if theirs.type == mine.type:
        return ""
    kinds = (item.type.text(RosVersion.ROS1) for item in (theirs, mine))
    return f"field '{mine.name}' was {next(kinds)} and is {next(kinds)}"
