"""For tests of robot packages: launches, graphs and simulations that end with the test.

The fixtures of `gazelle.testing.plugin` come by themselves where pytest and Gazelle are installed;
what is here serves fixtures of one's own, such as one launch for a whole module.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazelle.graph.isolated_graph import open_graph
    from gazelle.testing.launch import Launch, launched
    from gazelle.testing.messages import Messages

__all__ = ["Launch", "Messages", "launched", "open_graph"]

_MODULES = {
    "Launch": "gazelle.testing.launch",
    "Messages": "gazelle.testing.messages",
    "launched": "gazelle.testing.launch",
    "open_graph": "gazelle.graph.isolated_graph",
}


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        from importlib import import_module

        return getattr(import_module(_MODULES[name]), name)
    raise AttributeError(f"module 'gazelle.testing' has no attribute '{name}'")
