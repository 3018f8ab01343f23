"""The parameter tree, as viewers read, set and follow it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from gazelle.errors import GazelleError, GraphError
from gazelle.graph.delivery import Mailbox
from gazelle.graph.names import check_name, resolve

if TYPE_CHECKING:
    from gazelle.graph import ParameterStore

__all__ = ["Parameters"]


class Parameters:
    """Parameters by global name: single values, no namespaces."""

    def __init__(self, store: ParameterStore, notice: Callable[[str], None]) -> None:
        """Wrap the store.

        Args:
            store: of the graph.
            notice: told what cannot be set.
        """
        self._store = store
        self._notice = notice
        self._changes: Mailbox | None = None

    def follow(self, tell: Callable[[Mapping[str, Any]], None]) -> None:
        """Call back with what changes from now on; None for what is not set any more."""
        before = self.get(())

        def tell_changes(_name: str) -> None:
            nonlocal before
            now = self.get(())
            changes = {k: v for k, v in now.items() if k not in before or before[k] != v}
            changes |= dict.fromkeys(before.keys() - now.keys())
            before = now
            if changes:
                tell(changes)

        # The store waits for its listeners, and so may the server for the store.
        self._changes = Mailbox(tell_changes, size=1, name="foxglove parameters")
        self._store.on_change(self._changes.put)

    def close(self) -> None:
        """Tell of no changes any more."""
        if self._changes is not None:
            self._changes.close()

    def get(self, names: Iterable[str]) -> dict[str, Any]:
        """Return values by name, all of them without names."""
        known = dict(_leaves(self._store.get_cached("/", {}), ""))
        wanted = list(names)
        return {name: known[name] for name in wanted if name in known} if wanted else known

    def set(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Set values, delete those that are None; return what they are afterwards."""
        for name, value in values.items():
            try:
                self._set(name, value)
            except GazelleError as error:
                self._notice(f"a viewer cannot set parameter {name}: {error}")
            except KeyError:
                self._notice(f"a viewer cannot delete parameter {name}: it is not set")
        known = self.get(())
        return {name: known.get(name) for name in values}

    def _set(self, name: str, value: Any) -> None:
        full = resolve(check_name(name, "parameter name"))
        if full == "/":
            raise GraphError("that is the whole tree; set its parameters one by one")
        if value is None:
            self._store.delete(full)
        else:
            self._store.set(full, value)


def _leaves(value: Any, name: str) -> Iterator[tuple[str, Any]]:
    if isinstance(value, dict):
        for part, below in value.items():
            yield from _leaves(below, f"{name}/{part}")
    else:
        yield name, value
