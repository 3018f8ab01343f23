"""How much of a user's files is worked on: bytes, elements, aliases, the work of expressions.

Every limit is far above what real robots and worlds need, and every message that names one says
how to raise it.
"""

from __future__ import annotations

from gazelle.limits.budget import Budget
from gazelle.limits.expressions import compile_limited, names_in_code
from gazelle.limits.files import TEXT_BYTES, FileLimitError, read_limited, read_text_limited
from gazelle.limits.scale import HOW_TO_RAISE, LimitError, scaled

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
