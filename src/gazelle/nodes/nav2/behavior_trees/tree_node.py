"""What every node of a tree is: a status, ports on the blackboard, a tick and a halt."""

from __future__ import annotations

import enum
from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from gazelle.errors import GazelleError
from gazelle.nodes.nav2.behavior_trees.ros_interface import RosInterface

__all__ = [
    "FRAME_PORTS",
    "Blackboard",
    "Decorator",
    "Leaf",
    "Ports",
    "Status",
    "SubTree",
    "TreeError",
    "TreeNode",
]


FRAME_PORTS = ("global_frame", "robot_base_frame")
"""Inputs of nodes that ask where the robot is."""
_REQUIRED: Any = object()


class Blackboard:
    """Values by key; that of a subtree passes some keys on to the tree above.

    A key that begins with ``@`` is one of the outermost tree (BehaviorTree.CPP 4).
    """

    def __init__(
        self,
        parent: Blackboard | None = None,
        remapped: Mapping[str, str] | None = None,
        *,
        takes_all: bool = False,
    ) -> None:
        """Begin empty.

        Args:
            parent: of the tree above.
            remapped: keys here and their names above.
            takes_all: every key that is not private (``_…``) is the parent's of the same name.
        """
        self._parent = parent
        self._remapped = dict(remapped or {})
        self._takes_all = takes_all
        self._values: dict[str, Any] = {}

    @property
    def root(self) -> Blackboard:
        """The outermost tree's."""
        return self if self._parent is None else self._parent.root

    def has(self, key: str) -> bool:
        """Tell whether a key has a value."""
        board, name = self._place(key)
        return name in board._values

    def get(self, key: str, default: Any = None) -> Any:
        """Return a value."""
        board, name = self._place(key)
        return board._values.get(name, default)

    def set(self, key: str, value: Any) -> None:
        """Keep a value."""
        board, name = self._place(key)
        board._values[name] = value

    def unset(self, key: str) -> None:
        """Forget a value."""
        board, name = self._place(key)
        board._values.pop(name, None)

    def _place(self, key: str) -> tuple[Blackboard, str]:
        if key.startswith("@"):
            return self.root._place(key[1:])
        if self._parent is not None:
            if key in self._remapped:
                return self._parent._place(self._remapped[key])
            if self._takes_all and not key.startswith("_"):
                return self._parent._place(key)
        return self, key


class TreeError(GazelleError):
    """A node of a tree cannot do its work; the text names node and port."""


class Status(enum.Enum):
    """What a tick came to; the value is the word of ``nav2_msgs/BehaviorTreeStatusChange``."""

    IDLE = "IDLE"
    RUNNING = "RUNNING"
    SUCCESS = "SUCCESS"
    FAILURE = "FAILURE"
    SKIPPED = "SKIPPED"

    @property
    def is_done(self) -> bool:
        """True for SUCCESS and FAILURE."""
        return self in (Status.SUCCESS, Status.FAILURE)


class Ports:
    """The attributes of one node: texts, and ``{keys}`` of the blackboard."""

    def __init__(self, node: str, attributes: Mapping[str, str], blackboard: Blackboard) -> None:
        """Read nothing yet."""
        self.blackboard = blackboard
        self._node = node
        self._attributes = attributes

    def has(self, name: str) -> bool:
        """Tell whether a port is connected and, if to a key, the key has a value."""
        text = self._attributes.get(name)
        if text is None:
            return False
        key = self._key(name, text)
        return key is None or self.blackboard.has(key)

    def get(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return a port's value.

        Raises:
            TreeError: it has none and there is no default.
        """
        text = self._attributes.get(name)
        key = None if text is None else self._key(name, text)
        if key is not None and self.blackboard.has(key):
            return self.blackboard.get(key)
        if text is not None and key is None:
            return text
        if default is not _REQUIRED:
            return default
        what = f"key '{key}' of the blackboard is not set" if key else "the port is not given"
        raise TreeError(f"[{self._node}]: missing required input [{name}]: {what}")

    def number(self, name: str, default: float = _REQUIRED) -> float:
        """Return a port's value as a number.

        Raises:
            TreeError: it is none.
        """
        value = self.get(name, default)
        try:
            return float(value)
        except (TypeError, ValueError) as error:
            text = f"[{self._node}]: port [{name}] is {value!r}, not a number"
            raise TreeError(text) from error

    def flag(self, name: str, default: bool = _REQUIRED) -> bool:
        """Return a port's value as a truth value.

        Raises:
            TreeError: it is none.
        """
        value = self.get(name, default)
        if isinstance(value, bool | int | float):
            return bool(value)
        if str(value).lower() in ("true", "false", "1", "0"):
            return str(value).lower() in ("true", "1")
        raise TreeError(f"[{self._node}]: port [{name}] is {value!r}, not true or false")

    def set(self, name: str, value: Any) -> None:
        """Write an output; a port that is not connected takes nothing."""
        text = self._attributes.get(name)
        key = None if text is None else self._key(name, text)
        if key is not None:
            self.blackboard.set(key, value)

    def text(self, name: str) -> str | None:
        """Return an attribute as it is written."""
        return self._attributes.get(name)

    @staticmethod
    def _key(name: str, text: str) -> str | None:
        """Return the key that a text points to; ``{=}`` is the port's own name."""
        text = text.strip()
        if not (text.startswith("{") and text.endswith("}")):
            return None
        key = text[1:-1].strip()
        return name if key == "=" else key


class TreeNode:
    """A node of a tree; subclasses say what a tick does.

    Attributes:
        INPUTS: ports that are read.
        OUTPUTS: ports that are written.
        CHILDREN: least and most number of children, None for no limit.
        name: the attribute ``name``, or the node's type.
        status: of the last tick; IDLE before the first one and after a halt.
        children: nodes below.
        ports: its attributes.
        ros: robot, actions and services.
        on_change: hears each change of the status.
    """

    INPUTS: ClassVar[tuple[str, ...]] = ()
    OUTPUTS: ClassVar[tuple[str, ...]] = ()
    CHILDREN: ClassVar[tuple[int, int | None]] = (0, 0)

    def __init__(
        self, name: str, ports: Ports, children: Sequence[TreeNode], ros: RosInterface
    ) -> None:
        """Stand still."""
        self.name = name
        self.status = Status.IDLE
        self.children = tuple(children)
        self.ports = ports
        self.ros = ros
        self.on_change: Callable[[TreeNode, Status], None] | None = None
        self.begin()

    def begin(self) -> None:
        """Set up what a subclass keeps between ticks."""

    def tick(self) -> Status:
        """Do what there is to do."""
        raise NotImplementedError

    def halted(self) -> None:
        """Forget what was going on."""

    def execute(self) -> Status:
        """Tick and keep the status."""
        self.note(self.tick())
        return self.status

    def halt(self) -> None:
        """End what is going on, here and below."""
        self.halted()
        self.halt_children()
        self.note(Status.IDLE)

    def halt_children(self, start: int = 0) -> None:
        """Halt the children from one on."""
        for child in self.children[start:]:
            self.halt_child(child)

    @staticmethod
    def halt_child(child: TreeNode) -> None:
        """Halt a child if it runs; it is idle afterwards."""
        if child.status is Status.RUNNING:
            child.halt()
        child.note(Status.IDLE)

    def note(self, status: Status) -> None:
        """Keep a status and tell who listens."""
        before, self.status = self.status, status
        if before is not status and self.on_change is not None:
            self.on_change(self, before)


class Leaf(TreeNode):
    """A node without children."""


class Decorator(TreeNode):
    """A node with one child."""

    CHILDREN = (1, 1)

    @property
    def child(self) -> TreeNode:
        """The child."""
        return self.children[0]


class SubTree(Decorator):
    """Says what the tree below says."""

    def tick(self) -> Status:
        """Tick the tree below; when that is over it is idle again."""
        status = self.child.execute()
        if status.is_done:
            self.halt_children()
        return status
