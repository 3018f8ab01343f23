"""A family of plug-ins tried by every name it has, in a robot or world where it belongs."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation

__all__ = ["HERE", "KEYS", "FamilyRow", "Trial", "number", "vector"]

# In a document: the name of the library, and the keys of the plug-in.
HERE, KEYS = "@", "@KEYS@"


@dataclass(frozen=True)
class FamilyRow:
    """How a family is tried.

    Attributes:
        family: of its table.
        document: robot or world, with `HERE` for the library's name and `KEYS` for the keys.
        law: plays the user and asserts what has to come out.
        spellings: keys, once for each way to write them.
        options: of `Simulation.load`.
        said: codes that have to be reported; nothing else may be.
    """

    family: str
    document: str
    law: Callable[[Trial], None]
    spellings: tuple[str, ...] = ("",)
    options: Mapping[str, Any] = field(default_factory=dict)
    said: frozenset[str] = frozenset()

    def written(self, name: str, keys: str) -> str:
        """Return the document with a plug-in of this name.

        The name of a class stands beside a library that nobody knows, as some files have it.
        """
        tag = f'name="p" filename="lib{name}.so"'
        if name.startswith(("gz-", "ign")):
            tag = f'filename="{name}" name="p"'
        if "::" in name:
            tag = f'filename="libsome-system.so" name="{name}"'
        text, count = re.subn(rf'name="\w+" filename="{HERE}"', tag, self.document)
        assert count == 1
        return text.replace(KEYS, keys)

    def check(self, load: Callable[..., Simulation], name: str, keys: str) -> None:
        """Load it and hold it to its law; nothing may be reported but what has to be."""
        trial = Trial(load(self.written(name, keys), **self.options), name, keys)
        self.law(trial)
        assert {item.code for item in trial.sim.diagnostics} == self.said


@dataclass(frozen=True)
class Trial:
    """A loaded simulation, before its first step."""

    sim: Simulation
    name: str
    keys: str

    @property
    def is_ros2(self) -> bool:
        """Whether the keys are spelled as in ROS 2."""
        return "<ros>" in self.keys

    def listen(self, topic: str) -> list[Any]:
        """Collect the messages of a topic."""
        messages: list[Any] = []
        self.sim.subscribe(topic, messages.append)
        return messages

    def command(self, topic: str, x: float = 0.0, y: float = 0.0, turn: float = 0.0) -> None:
        """Publish a velocity."""
        self.sim.publish(topic, twist_message((x, y, 0.0), (0.0, 0.0, turn)))

    def move(self, model: str, position: tuple[float, float, float]) -> None:
        """Put a model somewhere."""
        self.sim.model(model).pose = Pose(position)


def number(value: float) -> Any:
    """A std_msgs/Float64."""
    return message_type("std_msgs/Float64")(data=value)


def vector(message: Any) -> list[float]:
    """x, y, z of a message."""
    return [message.x, message.y, message.z]
