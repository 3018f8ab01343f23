"""Values of parameters as the protocol has them."""

from __future__ import annotations

import math
from typing import Any

__all__ = ["plain_value"]


def plain_value(value: Any) -> Any:
    """Return a parameter's value in types that the protocol has; dates and nan become text."""
    if isinstance(value, dict):
        return {str(name): plain_value(one) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain_value(one) for one in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if value is None or isinstance(value, bool | int | float | str | bytes):
        return value
    return str(value)
