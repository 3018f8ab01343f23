"""Python text to a syntax tree."""

from __future__ import annotations

import ast

__all__ = ["parse_python"]


def parse_python(text: str) -> ast.Module:
    """Return a text's syntax tree.

    Raises:
        SyntaxError: it is no Python 3, or nested deeper than Python reads.
    """
    try:
        return ast.parse(text)
    except (MemoryError, RecursionError) as error:
        raise SyntaxError("too many nested parentheses") from error
    except ValueError as error:
        raise SyntaxError(str(error)) from error
