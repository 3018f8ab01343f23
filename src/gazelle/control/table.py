"""Tables that describe a controller: types, parameters, topics, interfaces.

The reader of parameters takes its defaults from them, and `docs/controllers.md` is generated from
them, so the page cannot say anything else than the code does.
"""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.parameters import ParameterTable, Topic

__all__ = ["ControllerTable"]


@dataclass(frozen=True, slots=True)
class ControllerTable:
    """Everything the documentation says about one family of controllers.

    Attributes:
        parameters: family, summary and rows; types of both generations, of which ROS 1's have the
            hardware interface in them.
        interfaces: what it claims and reads, in words.
        topics: topics, services and actions.
        behaviour: facts of behaviour, one sentence each, with their source.
    """

    parameters: ParameterTable
    interfaces: str
    topics: tuple[Topic, ...] = ()
    behaviour: tuple[str, ...] = ()
