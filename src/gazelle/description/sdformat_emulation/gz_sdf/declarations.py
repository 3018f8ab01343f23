"""Where TinyXML-2 takes ``<?…?>``: at the start of a document only."""

from __future__ import annotations

import re

__all__ = ["declaration_problem"]

# What may hold "<?" without being one, and what is one; the longest first.
_PIECES = re.compile(r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?(?P<value>.*?)\?>|<", re.DOTALL)


def declaration_problem(data: str | bytes) -> str:
    """Return what sdformat 12 prints of a declaration that stands too late, empty for none.

    TinyXML-2 (``XMLNode::ParseDeep``) takes declarations before anything else, comments included;
    TinyXML 1, which sdformat 9 uses, takes them anywhere.
    """
    text = data if isinstance(data, str) else data.decode("utf-8", "replace")
    is_start = True
    for piece in _PIECES.finditer(text):
        value = piece["value"]
        if value is None:
            is_start = False
        elif not is_start:
            line = text.count("\n", 0, piece.start()) + 1
            return (
                f"Error=XML_ERROR_PARSING_DECLARATION ErrorID=11 (0xb) Line number={line}: "
                f"XMLDeclaration value={value}"
            )
    return ""
