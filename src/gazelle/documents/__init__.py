"""Users' files, read within bounds: bytes, elements, aliases, the work of expressions.

Every limit is far above what real robots and worlds need, and every message that names one says
how to raise it.
"""

from __future__ import annotations

from gazelle.documents.budget import Budget
from gazelle.documents.expressions import compile_limited, names_in_code
from gazelle.documents.files import TEXT_BYTES, FileLimitError, read_limited, read_text_limited
from gazelle.documents.scale import HOW_TO_RAISE, LimitError, scaled

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
