"""Running a command."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Mapping
from typing import Any

from gazelle.launch.ros2.actions.event_actions import Shutdown
from gazelle.launch.ros2.actions.execute_local import ExecuteLocal
from gazelle.launch.ros2.descriptions import Executable
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.substitution import (
    SomeSubstitutionsType,
    Substitution,
    TextSubstitution,
)

__all__ = ["ExecuteProcess"]

# Attributes of <executable> and the arguments they are.
_TEXTS = {"cwd": "cwd", "name": "name", "launch-prefix": "prefix", "output": "output"}
_TYPED: dict[str, Any] = {
    "respawn_max_retries": int,
    "shell": bool,
    "emulate_tty": bool,
    "respawn_delay": float,
    "sigkill_timeout": float,
    "sigterm_timeout": float,
}


@expose_action("executable")
class ExecuteProcess(ExecuteLocal):
    """Runs a command.

    Attributes:
        name: its name, with a number once it is known.
        cmd: its words.
        cwd: its folder.
        env: its environment.
        additional_env: what is added to its environment.
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
        **kwargs: Any,
    ) -> None:
        what = Executable(
            cmd=cmd, prefix=prefix, name=name, cwd=cwd, env=env, additional_env=additional_env
        )
        super().__init__(process_description=what, **kwargs)

    @classmethod
    def _parse_cmdline(cls, cmd: str, parser: Parser) -> list[list[Substitution]]:
        """Return the words of a command line, whose blanks part them outside of ``$(…)``."""
        words: list[list[Substitution]] = []
        is_open = False
        for sub in parser.parse_substitution(cmd):
            pieces: list[Substitution] = [sub]
            begins = ends = False
            if isinstance(sub, TextSubstitution):
                text = sub.text
                pieces = [TextSubstitution(text=word) for word in shlex.split(text)]
                begins, ends = text[:1].isspace(), text[-1:].isspace()
            if begins:
                is_open = False
            for piece in pieces:
                if is_open:
                    words[-1].append(piece)
                else:
                    words.append([piece])
                is_open = piece is pieces[-1] and not ends
            if ends:
                is_open = False
        return words

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: list[str] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of an ``<executable>``.

        Args:
            entity: the element.
            parser: of the launch file.
            ignore: arguments that a subclass reads in its own way.

        Raises:
            ValueError: an attribute has a value that does not fit.
        """
        _, kwargs = super().parse(entity, parser)
        left_out = set(ignore or ())
        if "cmd" not in left_out:
            kwargs["cmd"] = cls._parse_cmdline(entity.get_attr("cmd"), parser)
        for attribute, name in _TEXTS.items():
            if name not in left_out:
                _put(kwargs, name, entity.get_attr(attribute, optional=True), parser)
        if "respawn" not in left_out:
            respawn = entity.get_attr("respawn", data_type=bool, optional=True)
            if respawn is not None:
                kwargs["respawn"] = parser.parse_if_substitutions(respawn)
        for name, kind in _TYPED.items():
            if name not in left_out:
                _put_typed(kwargs, name, kind, entity)
        if "on_exit" not in left_out:
            _put_on_exit(kwargs, entity)
        if "additional_env" not in left_out:
            _put_environment(kwargs, entity, parser)
        return cls, kwargs

    @property
    def name(self) -> Any:
        """Its name, with a number once it is known."""
        what = self.process_description
        return what.name if what.final_name is None else what.final_name

    @property
    def cmd(self) -> Any:
        """Its words; texts once they are known."""
        what = self.process_description
        return what.cmd if what.final_cmd is None else what.final_cmd

    @property
    def cwd(self) -> Any:
        """Its folder; a text once it is known."""
        what = self.process_description
        return what.cwd if what.final_cwd is None else what.final_cwd

    @property
    def env(self) -> Any:
        """Its environment; texts once they are known."""
        what = self.process_description
        return what.env if what.final_env is None else what.final_env

    @property
    def additional_env(self) -> Any:
        """What is added to its environment."""
        return self.process_description.additional_env


def _put(kwargs: dict[str, Any], name: str, value: str | None, parser: Parser) -> None:
    if value is not None:
        kwargs[name] = parser.parse_substitution(value)


def _put_typed(kwargs: dict[str, Any], name: str, kind: Any, entity: Entity) -> None:
    value = entity.get_attr(name, data_type=kind, optional=True)
    if value is None:
        return
    what = f"Attribute {name} of Entity {entity.type_name} expected to be"
    if isinstance(value, str):
        # A text would count as true, and no $(…) is evaluated here in ROS 2 either.
        raise ValueError(f"{what} a plain {kind.__name__} but got `{value}`")
    if kind is float and value < 0.0:
        raise ValueError(f"{what} a non-negative value but got `{value}`")
    kwargs[name] = str(value) if name.startswith("sig") else value


def _put_on_exit(kwargs: dict[str, Any], entity: Entity) -> None:
    value = entity.get_attr("on_exit", optional=True)
    if value is None:
        return
    if value != "shutdown":
        raise ValueError(
            f"Attribute on_exit of Entity {entity.type_name} expected to be shutdown but got "
            f"`{value}`. Other on_exit actions not yet supported"
        )
    kwargs["on_exit"] = [Shutdown()]


def _put_environment(kwargs: dict[str, Any], entity: Entity, parser: Parser) -> None:
    found = entity.get_attr("env", data_type=list[Entity], optional=True)
    if found is None:
        return
    kwargs["additional_env"] = {
        tuple(parser.parse_substitution(one.get_attr("name"))): parser.parse_substitution(
            one.get_attr("value")
        )
        for one in found
    }
    for one in found:
        one.assert_entity_completely_parsed()
