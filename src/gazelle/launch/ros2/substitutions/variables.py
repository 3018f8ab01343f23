"""Values of the launch: var, env, anon, locals, variables of loops, and texts that are joined."""

from __future__ import annotations

import os
import random
import re
import socket
import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import did_you_mean
from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions.substitution_failure import (
    SubstitutionFailure,
    counted,
    described,
)
from gazelle.launch.ros2.utilities import (
    ensure_argument_type,
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "AnonName",
    "EnvironmentVariable",
    "ForEachVar",
    "ForLoopIndex",
    "LaunchConfiguration",
    "LocalSubstitution",
    "StringJoinSubstitution",
]


@expose_substitution("string-join")
class StringJoinSubstitution(Substitution):
    """Texts with a delimiter between them.

    Attributes:
        substitutions: the texts; each may be several substitutions.
        delimiter: what stands between two of them.
    """

    def __init__(
        self, substitutions: Iterable[SomeSubstitutionsType], delimiter: SomeSubstitutionsType = ""
    ) -> None:
        super().__init__()
        self.substitutions = [normalize_to_list_of_substitutions(one) for one in substitutions]
        self.delimiter = normalize_to_list_of_substitutions(delimiter)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[StringJoinSubstitution], dict[str, Any]]:
        """Return class and arguments of a ``$(string-join delimiter text ...)``."""
        if len(data) < 2:
            raise TypeError(
                "string-join substitution expects at least 2 arguments: the delimiter and a text"
            )
        return cls, {"delimiter": data[0], "substitutions": data[1:]}

    def describe(self) -> str:
        """Return a text for people."""
        texts = ", ".join(described(one) for one in self.substitutions)
        return f"StringJoin([{texts}], delimiter={described(self.delimiter)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the joined text."""
        texts = [perform_substitutions(context, one) for one in self.substitutions]
        return perform_substitutions(context, self.delimiter).join(texts)


@expose_substitution("for-var")
class ForEachVar(Substitution):
    """The value that a ``ForEach`` has for a name in the round at hand.

    Attributes:
        name: of the variable.
        default_value: what it is in a round without a value, or None.
    """

    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(name)
        self.default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[ForEachVar], dict[str, Any]]:
        """Return class and arguments of a ``$(for-var name default)``."""
        words = counted(data, 1, 2, "for-var")
        kwargs = {"name": words[0]}
        if len(words) == 2:
            kwargs["default_value"] = words[1]
        return cls, kwargs

    def describe(self) -> str:
        """Return a text for people."""
        default = described(self.default_value or [])
        return f"{type(self).__name__}(name={described(self.name)}, default_value={default})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value.

        Raises:
            SubstitutionFailure: there is none here, and no default.
        """
        name = perform_substitutions(context, self.name)
        values = context.get_locals_as_dict()
        if (key := self.get_local_arg_name(name)) in values:
            return str(values[key])
        if self.default_value is not None:
            return perform_substitutions(context, self.default_value)
        raise SubstitutionFailure(
            f"No value available for {type(self).__name__} '{name}' and no default value provided"
        ).explained(fix="write it inside of the loop, and let every round have the name")

    @classmethod
    def get_local_arg_name(cls, name: str) -> str:
        """Return what a variable is called among the context's locals."""
        return f"ForEachVar__{name}"


@expose_substitution("index")
class ForLoopIndex(ForEachVar):
    """The number of the round that a ``ForLoop`` is in."""

    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None:
        super().__init__(name)


@expose_substitution("var")
class LaunchConfiguration(Substitution):
    """The value of a launch configuration, such as an argument's.

    Attributes:
        variable_name: its name.
    """

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any = None) -> None:
        super().__init__()
        self.variable_name = normalize_to_list_of_substitutions(variable_name)
        self.__default = None if default is None else _texts(default)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[LaunchConfiguration], dict[str, Any]]:
        """Return class and arguments of a ``$(var name default)``."""
        names = ("variable_name", "default")
        return cls, dict(zip(names, counted(data, 1, 2, "var"), strict=False))

    def describe(self) -> str:
        """Return a text for people."""
        return f"LaunchConfig({described(self.variable_name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value.

        Raises:
            SubstitutionFailure: it is not set and there is no default.
        """
        name = perform_substitutions(context, self.variable_name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self.__default is not None:
            return perform_substitutions(context, self.__default)
        hint = did_you_mean(name, sorted(context.launch_configurations))
        message = f"launch configuration '{name}' does not exist"
        raise SubstitutionFailure(f"{message}; {hint}" if hint else message).explained(
            fix=f"declare it before this line: DeclareLaunchArgument('{name}', default_value=…)"
        )


@expose_substitution("env")
class EnvironmentVariable(Substitution):
    """The value of an environment variable.

    Attributes:
        name: of the variable.
        default_value: when it is not set, None for an error.
    """

    def __init__(
        self,
        name: SomeSubstitutionsType,
        *,
        default_value: SomeSubstitutionsType | None = None,
    ) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(name)
        self.default_value = (
            None if default_value is None else normalize_to_list_of_substitutions(default_value)
        )

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[EnvironmentVariable], dict[str, Any]]:
        """Return class and arguments of an ``$(env name default)``."""
        names = ("name", "default_value")
        return cls, dict(zip(names, counted(data, 1, 2, "env"), strict=False))

    def describe(self) -> str:
        """Return a text for people."""
        return f"EnvVar({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value.

        Raises:
            SubstitutionFailure: it is not set and there is no default.
        """
        name = perform_substitutions(context, self.name)
        if name in context.environment:
            return context.environment[name]
        if self.default_value is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist").explained(
                fix=f"export {name}=… in the shell before the launch, or give a default_value"
            )
        return perform_substitutions(context, self.default_value)


@expose_substitution("anon")
class AnonName(Substitution):
    """A name nobody else has; the same one for the same name within a launch.

    Attributes:
        name: what it begins with.
    """

    def __init__(self, name: SomeSubstitutionsType) -> None:
        super().__init__()
        self.name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[AnonName], dict[str, Any]]:
        """Return class and arguments of an ``$(anon name)``."""
        return cls, {"name": counted(data, 1, 1, "anon")[0]}

    def describe(self) -> str:
        """Return a text for people."""
        return f"AnonName({described(self.name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the name."""
        name = perform_substitutions(context, self.name)
        return context.launch_configurations.setdefault(f"anon{name}", self.compute_name(name))

    def compute_name(self, id_value: str) -> str:
        """Return a new name: host, process and a random number behind the given one."""
        number = random.randint(0, sys.maxsize)
        return re.sub("[.:-]", "_", f"{id_value}_{socket.gethostname()}_{os.getpid()}_{number}")


class LocalSubstitution(Substitution):
    """A member of the context's locals, such as ``event.pid``.

    Attributes:
        expression: what stands behind ``context.locals.``.
        description: the same for people.
    """

    def __init__(self, expression: str, description: str | None = None) -> None:
        super().__init__()
        ensure_argument_type(expression, str, "expression", "LocalSubstitution")
        self.expression = expression
        self.description = description

    def describe(self) -> str:
        """Return a text for people."""
        return f"LocalVar('{self.description or self.expression}')"

    def perform(self, context: LaunchContext) -> str:
        """Return its value; what is no text stays what it is, as in ROS 2."""
        names = {"context": context}
        value: Any = eval(f"context.locals.{self.expression}", {}, names)  # noqa: S307 - as documented
        return value  # type: ignore[no-any-return]


def _texts(default: Any) -> list[Substitution]:
    items = default if isinstance(default, Iterable) else (default,)
    if isinstance(default, str):
        items = [default]
    return normalize_to_list_of_substitutions(
        [item if isinstance(item, str | Substitution) else str(item) for item in items]
    )
