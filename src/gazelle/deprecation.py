"""Names that were renamed and still work, with a warning, for one release.

What is promised to stay stands in ``docs/stability.md``.
"""

from __future__ import annotations

import warnings

__all__ = ["warn_renamed"]


def warn_renamed(old: str, new: str, *, gone_in: str) -> None:
    """Warn whoever uses an old name; call it from the property or ``__getattr__`` that has it.

    Args:
        old: the name as it was used, such as ``gazelle.interfaces.Generation``.
        new: the name to use instead.
        gone_in: the release that has the old name no more, such as ``"0.3.0"``.
    """
    text = f"{old} is called {new} now; the old name goes with Gazelle {gone_in}"
    warnings.warn(text, DeprecationWarning, stacklevel=3)
