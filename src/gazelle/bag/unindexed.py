"""What is said of a bag that was not closed."""

from __future__ import annotations

from gazelle.bag.formats import format_of_name
from gazelle.bag.storage import BagReader
from gazelle.diagnostics import Diagnostics, SourceSpan, render

__all__ = ["tell_of_unindexed"]


def tell_of_unindexed(bag: BagReader) -> None:
    """Say on stderr that a bag was not closed, and what that means."""
    summary = bag.summary
    if summary.is_indexed:
        return
    tool = format_of_name(bag.storage).reindex
    lost = f"; its last {summary.lost} bytes are no whole piece" if summary.lost else ""
    text = f"the bag was not closed{lost}; {summary.messages} messages can be read"
    found = Diagnostics()
    found.report("bag.unindexed", text, SourceSpan(str(bag.path)), fix=f"run `{tool} {bag.path}`")
    render(found)
