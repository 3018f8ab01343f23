"""What a conversion could not say, as comments at the head of the new file."""

from __future__ import annotations

from gazelle.description.conversion.beside import Beside
from gazelle.diagnostics import Diagnostics, Severity

__all__ = ["head_comments", "report_addresses"]

_MOST = 40


def head_comments(source: str, found: Diagnostics) -> list[str]:
    """Return comments: where the file comes from, and what was lost or said differently.

    Args:
        source: name of the file converted, or of its format.
        found: the conversion's findings.
    """
    comments = [f"Converted by gazelle convert from {source}."]
    lost = [item.message for item in found if item.severity >= Severity.WARNING]
    changed = [item.message for item in found if item.severity < Severity.WARNING]
    for title, messages in (("Not in this file:", lost), ("Said differently:", changed)):
        shown = [f"- {message}" for message in messages[:_MOST]]
        if len(messages) > _MOST:
            shown.append(f"- and {len(messages) - _MOST} more")
        if shown:
            comments.append("\n".join([title, *shown]))
    return comments


def report_addresses(beside: Beside, diagnostics: Diagnostics) -> None:
    """Report files that must be copied to where their new address leads."""
    for address, path in beside.to_copy.items():
        message = f"'{path}' is named {address} and is not there yet"
        diagnostics.report("convert.file-address", message)
