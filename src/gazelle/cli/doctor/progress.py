"""What is being looked at, on the terminal of a person who waits."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["progress"]


@contextmanager
def progress() -> Iterator[Callable[[str], None] | None]:
    """Show on the terminal what is being looked at; programs that read are left in peace."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console

    with Console(file=sys.stderr).status("examining") as status:
        yield status.update
