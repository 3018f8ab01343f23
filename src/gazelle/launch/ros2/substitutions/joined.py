"""Texts that are joined, and variables of loops."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.frontend import expose_substitution
from gazelle.launch.ros2.substitution import SomeSubstitutionsType, Substitution
from gazelle.launch.ros2.substitutions.substitution_failure import (
    SubstitutionFailure,
    counted,
    described,
)
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["ForEachVar", "ForLoopIndex", "StringJoinSubstitution"]


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
