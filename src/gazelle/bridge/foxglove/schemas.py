"""Schemas of types, and word of those that nothing here defines."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.errors import GazelleError, NotFoundError
from gazelle.interfaces import ros2_definition

__all__ = ["SchemaBook"]


class SchemaBook:
    """Looks schemas up and tells once of each type that viewers cannot have."""

    def __init__(self, notice: Callable[[str], None]) -> None:
        """Know nothing yet.

        Args:
            notice: told what viewers cannot have.
        """
        self._notice = notice
        self._told: set[str] = set()

    def message(self, type_name: str, where: str) -> str | None:
        """Return a type's ``ros2msg`` schema, None where viewers cannot have it.

        Args:
            type_name: ``pkg/msg/Name``, or ``pkg/srv/Name_Request``.
            where: what has that type, for the notice.
        """
        try:
            return ros2_definition(type_name)
        except NotFoundError:
            text = (
                f"{where} is not shown: nothing here defines its type {type_name}\n"
                "  fix: start the bridge where the package that defines it is found"
            )
        except GazelleError as error:
            text = f"{where} is not shown: {error}"
        if type_name not in self._told:
            self._told.add(type_name)
            self._notice(text)
        return None
