"""launch.descriptions: what to run."""

from __future__ import annotations

import itertools
import re
import shlex
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions import LaunchConfiguration
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.action import Action
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["Executable"]

_numbers = itertools.count(1)
_Pairs = list[tuple[list[Substitution], list[Substitution]]]


class Executable:
    """A command with its folder and environment.

    What depends on the running launch is in the ``final_`` attributes after `prepare`.

    Attributes:
        cmd: its words.
        prefix: words that go before them, such as a debugger's.
        name: what its output begins with, None for the program's own name.
        cwd: its folder, None for the launcher's.
        env: its environment, None for the launcher's.
        additional_env: what is added to it.
        arguments: the words that were given apart from `cmd`.
        final_cmd: its words at last.
        final_name: its name with a number, such as ``talker-1``.
        final_cwd: its folder at last.
        final_env: its environment at last.
    """

    def __init__(
        self,
        *,
        cmd: Iterable[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Mapping[Any, SomeSubstitutionsType] | None = None,
        additional_env: Mapping[Any, SomeSubstitutionsType] | None = None,
        arguments: Iterable[SomeSubstitutionsType] | None = None,
    ) -> None:
        self.arguments = None if arguments is None else list(arguments)
        self.cmd = [normalize_to_list_of_substitutions(x) for x in (*cmd, *(self.arguments or ()))]
        self.prefix = normalize_to_list_of_substitutions(
            LaunchConfiguration("launch-prefix", default="") if prefix is None else prefix
        )
        self.__has_own_prefix = prefix is not None
        self.name = None if name is None else normalize_to_list_of_substitutions(name)
        self.cwd = None if cwd is None else normalize_to_list_of_substitutions(cwd)
        self.env = _pairs(env)
        self.additional_env = _pairs(additional_env)
        self.final_cmd: list[str] | None = None
        self.final_name: str | None = None
        self.final_cwd: str | None = None
        self.final_env: dict[str, str] | None = None

    def prepare(self, context: LaunchContext, action: Action) -> None:
        """Find out everything that depends on the running launch.

        Args:
            context: of the launch.
            action: that will run it, for subclasses.
        """
        cmd = [perform_substitutions(context, word) for word in self.cmd]
        program = Path(cmd[0]).name if cmd else ""
        self.final_cmd = [*self._prefix_argv(context, program), *cmd]
        name = Path(self.final_cmd[0]).name if self.final_cmd else ""
        if self.name is not None:
            name = perform_substitutions(context, self.name)
        self.final_name = f"{name}-{next(_numbers)}"
        self.final_cwd = None if self.cwd is None else perform_substitutions(context, self.cwd)
        env = dict(context.environment) if self.env is None else _performed(context, self.env)
        self.final_env = {**env, **_performed(context, self.additional_env or [])}

    def _prefix_argv(self, context: LaunchContext, program: str) -> list[str]:
        """Return the prefix; one from the command line goes only before programs of its filter."""
        argv = shlex.split(perform_substitutions(context, self.prefix))
        pattern = context.launch_configurations.get("launch-prefix-filter", "")
        if self.__has_own_prefix or re.match(pattern, program):
            return argv
        return []


def _pairs(values: Mapping[Any, SomeSubstitutionsType] | None) -> _Pairs | None:
    if values is None:
        return None
    return [
        (normalize_to_list_of_substitutions(key), normalize_to_list_of_substitutions(value))
        for key, value in values.items()
    ]


def _performed(context: LaunchContext, pairs: _Pairs) -> dict[str, str]:
    return {
        perform_substitutions(context, key): perform_substitutions(context, value)
        for key, value in pairs
    }
