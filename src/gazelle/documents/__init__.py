"""Users' files, read within bounds: bytes, elements, aliases, the work of expressions.

Every limit is far above what real robots and worlds need, and every message that names one says
how to raise it.
"""

from __future__ import annotations

from gazelle.documents.expressions import Budget, compile_limited, names_in_code
from gazelle.documents.files import (
    HOW_TO_RAISE,
    TEXT_BYTES,
    FileLimitError,
    LimitError,
    read_limited,
    read_text_limited,
    scaled,
)

__all__ = [
    "HOW_TO_RAISE",
    "TEXT_BYTES",
    "Budget",
    "FileLimitError",
    "LimitError",
    "compile_limited",
    "names_in_code",
    "read_limited",
    "read_text_limited",
    "scaled",
]
