"""Scripts that go into cells, and how values get into them."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

__all__ = ["script_tag"]


def script_tag(name: str, **values: Any) -> str:
    """Return a ``<script>`` with a file of this folder.

    Args:
        name: of the file, without ``.js``.
        values: JSON values, in place of the words of their names in capitals.
    """
    text = _text(name)
    for word, value in values.items():
        # What a name holds must not end the script.
        json_text = json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")
        text = text.replace(f"= {word.upper()};", f"= {json_text};")
    return f"<script>{text}</script>"


@lru_cache
def _text(name: str) -> str:
    lines = (Path(__file__).parent / f"{name}.js").read_text(encoding="utf-8").splitlines()
    kept = (line.strip() for line in lines)
    return "\n".join(line for line in kept if line and not line.startswith("//"))
