"""The catalogue as a page: `python -m gazelle.diagnostics.documentation > docs/diagnostics.md`."""

from __future__ import annotations

import re
import sys
from importlib import metadata

from gazelle.diagnostics.catalogue import Entry, all_entries

__all__ = ["anchor", "catalogue_markdown", "entry_address", "pages_address"]

_DISTRIBUTION = "gazelle-sim"
_DOCUMENTATION = "Documentation"

_HEAD = """# Diagnostics

Every finding that Gazelle reports has one of these codes. A code never changes its meaning.
This page is generated: `python -m gazelle.diagnostics.documentation > docs/diagnostics.md`.
"""


def catalogue_markdown() -> str:
    """Return the page: one section per area, one entry per code."""
    lines = [_HEAD]
    area = ""
    for entry in all_entries().values():
        if entry.code.split(".")[0] != area:
            area = entry.code.split(".")[0]
            lines.append(f"## {area}\n")
        lines.append(_entry_markdown(entry))
    return "\n".join(lines)


def anchor(entry: Entry) -> str:
    """Return the name by which links reach an entry of the page."""
    kept = re.sub(r"[^\w\s-]", "", _headline(entry).replace("`", "")).strip().lower()
    return re.sub(r"[\s-]+", "-", kept)


def pages_address() -> str:
    """Return where the pages of this release are, as its metadata say; empty when they do not."""
    try:
        urls = metadata.metadata(_DISTRIBUTION).get_all("Project-URL") or []
    except metadata.PackageNotFoundError:
        return ""
    named = dict(url.split(", ", 1) for url in urls if ", " in url)
    return str(named.get(_DOCUMENTATION, "")).rstrip("/")


def entry_address(entry: Entry, pages: str) -> str:
    """Return where an entry stands in pages of `pages_address`; empty where there are none."""
    return f"{pages}/diagnostics/#{anchor(entry)}" if pages else ""


def _headline(entry: Entry) -> str:
    return f"`{entry.code}` ({entry.severity})"


def _entry_markdown(entry: Entry) -> str:
    head = f"### {_headline(entry)}\n\n**{entry.title}.** {entry.why}\n"
    text = f"{head}\nFix: {entry.fix}.\n"
    return f"{text}\nROS/Gazebo says: `{entry.phrase}`\n" if entry.phrase else text


if __name__ == "__main__":
    sys.stdout.write(catalogue_markdown())
