"""What is in force at a place of a launch file: namespace, arguments, remaps, environment."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from gazelle.diagnostics import SourceSpan

__all__ = ["Scope"]


@dataclass(slots=True)
class Scope:
    """The state of one element's children; `child` copies it, so nothing leaks upwards.

    Attributes:
        file: the file being read.
        namespace: absolute, ends with ``/``.
        args: arguments declared so far; None for one without value.
        given: arguments passed to this file and not yet declared.
        fixed: arguments declared with a fixed value.
        remaps: pairs (from, to), later ones win.
        env: environment for the nodes that follow.
        private_params: ``~name`` parameters for the nodes that follow.
        stack: places of the includes that led here, outermost first.
        pass_all: the include passed all its arguments, so unknown ones are fine.
        in_node: this is the inside of a ``<node>``: names are private to it.
    """

    file: str
    namespace: str = "/"
    args: dict[str, str | None] = field(default_factory=dict)
    given: dict[str, str] = field(default_factory=dict)
    fixed: set[str] = field(default_factory=set)
    remaps: tuple[tuple[str, str], ...] = ()
    env: dict[str, str] = field(default_factory=dict)
    private_params: dict[str, Any] = field(default_factory=dict)
    stack: tuple[SourceSpan, ...] = ()
    pass_all: bool = False
    in_node: bool = False

    def child(self, namespace: str = "") -> Scope:
        """Return a copy for a ``<group>`` or ``<node>``, one namespace deeper."""
        return replace(
            self,
            namespace=self.join(namespace),
            args=dict(self.args),
            fixed=set(self.fixed),
            env=dict(self.env),
            private_params=dict(self.private_params),
        )

    def included(
        self, file: str, namespace: str, given: dict[str, str], place: SourceSpan
    ) -> Scope:
        """Return the scope of an included file: it sees only the arguments given."""
        inner = self.child(namespace)
        return replace(
            inner, file=file, args={}, given=dict(given), fixed=set(), stack=(*self.stack, place)
        )

    def join(self, namespace: str) -> str:
        """Return a namespace resolved in this one, ending with ``/``."""
        if not namespace:
            return self.namespace
        joined = namespace if namespace.startswith("/") else self.namespace + namespace
        return joined.rstrip("/") + "/"

    def add_remap(self, source: str, target: str) -> None:
        """Add a remap; one for the same name is replaced."""
        kept = tuple(pair for pair in self.remaps if pair[0] != source)
        self.remaps = (*kept, (source, target))
