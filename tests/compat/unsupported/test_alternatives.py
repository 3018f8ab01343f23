"""What the sentences of refusal name instead is there."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def test_dotted_names_in_the_sentences_exist(passes: Callable[..., Any]) -> None:
    passes(r"""
import re
from importlib import import_module
from gazelle.compat.unsupported.modules import UNSUPPORTED_MODULES
from gazelle.compat.unsupported.attributes import UNSUPPORTED_ATTRIBUTES

def exists(name):
    parts = name.split(".")
    for count in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(parts[:count]))
        except ImportError:
            continue
        for part in parts[count:]:
            thing = getattr(thing, part, None)
        return thing is not None
    return False

sentences = {row.reason for row in (*UNSUPPORTED_MODULES, *UNSUPPORTED_ATTRIBUTES)}
named = {name for one in sentences for name in re.findall(r"\b[a-z_0-9]+(?:\.\w+)+", one)}
assert len(named) > 20
assert not [name for name in sorted(named) if not exists(name)]
""")
