"""The bases of finders and loaders as `importlib.abc` has them, without importing that.

It brings `importlib.resources`, `tempfile` and more, which no node needs for its start.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from importlib.abc import Loader, MetaPathFinder
else:

    class MetaPathFinder:
        """A finder of ``sys.meta_path``."""

    class Loader:
        """What makes a module that a finder found."""

        def create_module(self, spec: object) -> None:
            """Let Python make the module itself."""


__all__ = ["Loader", "MetaPathFinder"]
