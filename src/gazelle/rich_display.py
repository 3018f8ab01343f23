"""How a record says which renderer shows it in a notebook; nothing is imported until one asks."""

from __future__ import annotations

from collections.abc import Callable, Container
from importlib import import_module
from typing import Any, TypeVar

__all__ = ["Bundle", "shown_by"]

Bundle = dict[str, Any]
"""A record as a notebook takes it: MIME type → text, or base64 of a picture."""

_T = TypeVar("_T")
_Renderer = Callable[[Any], Bundle]


def shown_by(renderer: str) -> Callable[[type[_T]], type[_T]]:
    """Return a class decorator: a notebook shows objects of the class by a renderer.

    The renderer is imported when a notebook first asks. What it cannot show, a notebook shows as
    the text that it shows of anything.

    Args:
        renderer: ``module:function`` below `gazelle.notebook`.
    """
    module, _, name = renderer.partition(":")

    def decorated(shown: type[_T]) -> type[_T]:
        def mimebundle(
            self: Any, include: Container[str] | None = None, exclude: Container[str] | None = None
        ) -> Bundle:
            try:
                found: _Renderer = getattr(import_module(f"gazelle.notebook.{module}"), name)
                bundle = found(self)
            except Exception:  # noqa: BLE001 - who looks at a value must not get an error for it
                return {}
            return {
                kind: data
                for kind, data in bundle.items()
                if (include is None or kind in include) and (exclude is None or kind not in exclude)
            }

        shown._repr_mimebundle_ = mimebundle  # type: ignore[attr-defined]
        return shown

    return decorated
