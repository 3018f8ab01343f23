"""Parameters of both generations, as viewers read, set and follow them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gazelle.bridge.foxglove.node_parameters import NodeParameters
from gazelle.errors import GazelleError, GraphError
from gazelle.graph.callback_queue import Mailbox
from gazelle.graph.names import check_name, resolve
from gazelle.parameters.trees import leaves_at, values_only

if TYPE_CHECKING:
    from gazelle.graph import ParameterStore

__all__ = ["Parameters"]


class Parameters:
    """The tree's by global name, single values without namespaces; those of ROS 2's nodes."""

    def __init__(
        self, store: ParameterStore, nodes: NodeParameters, notice: Callable[[str], None]
    ) -> None:
        """Wrap both.

        Args:
            store: the tree.
            nodes: asks nodes of ROS 2.
            notice: told what cannot be set.
        """
        self._store = store
        self._nodes = nodes
        self._notice = notice
        self._changes: Mailbox | None = None

    def follow(self, tell: Callable[[Mapping[str, Any]], None]) -> None:
        """Call back with what changes from now on; None for what is not set any more."""
        before = self._tree()

        def tell_changes(_name: str) -> None:
            nonlocal before
            now = self._tree()
            changes = {k: v for k, v in now.items() if k not in before or before[k] != v}
            changes |= dict.fromkeys(before.keys() - now.keys())
            before = now
            if changes:
                tell(changes)

        # The store waits for its listeners, and so may the server for the store.
        self._changes = Mailbox(tell_changes, size=1, name="foxglove parameters")
        self._store.on_change(self._changes.put)
        self._nodes.follow(tell)

    def close(self) -> None:
        """Tell of no changes any more."""
        if self._changes is not None:
            self._changes.close()

    def get(self, names: Iterable[str]) -> dict[str, Any]:
        """Return values by name, all of them without names."""
        wanted = list(names)
        known = self._tree()
        if not wanted:
            return known | self._nodes.get(())
        of_nodes = [name for name in wanted if self._nodes.knows(name)]
        known |= self._nodes.get(of_nodes) if of_nodes else {}
        return {name: known[name] for name in wanted if name in known}

    def set(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Set values, delete those that are None; return what they are afterwards."""
        for name, value in values.items():
            try:
                self._set(name, value)
            except GazelleError as error:
                self._notice(f"a viewer cannot set parameter {name}: {error}")
            except KeyError:
                self._notice(f"a viewer cannot delete parameter {name}: it is not set")
        known = self.get(values)
        return {name: known.get(name) for name in values}

    def _tree(self) -> dict[str, Any]:
        return dict(values_only(leaves_at("/", self._store.get_cached("/", {}))))

    def _set(self, name: str, value: Any) -> None:
        if self._nodes.knows(name):
            self._nodes.set(name, value)
            return
        full = resolve(check_name(name, "parameter name"))
        if full == "/":
            raise GraphError("that is the whole tree; set its parameters one by one")
        if value is None:
            self._store.delete(full)
        else:
            self._store.set(full, value)
