"""Single names that are refused: their sentences are put on the drop-in modules at import.

A module's attribute is refused by the module's ``__getattr__``, a class's by a descriptor, and a
keyword by a wrapper. `hasattr` stays False, and what a user's class sets itself is found.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dis import opmap
from fnmatch import fnmatchcase
from functools import wraps
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import spec_from_file_location
from inspect import getattr_static
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any, NoReturn

from gazelle.compat.unsupported.attributes import UNSUPPORTED_ATTRIBUTES, UnsupportedAttribute
from gazelle.compat.unsupported.modules import UNSUPPORTED_MODULES, why_unsupported

__all__ = ["PlaceholderFinder", "attach_placeholders"]

_MODULES = Path(__file__).parents[1] / "modules"
_PATTERNS = "__refused_patterns__"
_KEYWORDS = "__refused_words__"


class _Placeholder:
    """Stands for an attribute that a class of the original has and ours has not."""

    def __init__(self, reason: str) -> None:
        self._reason = reason
        self._name = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, instance: object, owner: type) -> NoReturn:
        raise AttributeError(
            f"'{owner.__name__}' object has no attribute '{self._name}': gazelle: it {self._reason}"
        )


def _is_import(frame: FrameType | None) -> bool:
    """Tell whether a frame is at ``from module import name``."""
    return frame is not None and frame.f_code.co_code[frame.f_lasti] == opmap["IMPORT_FROM"]


def _refuse_in_module(module: ModuleType, pattern: str, reason: str) -> None:
    patterns: dict[str, str] | None = module.__dict__.get(_PATTERNS)
    if patterns is not None:
        patterns[pattern] = reason
        return
    module.__dict__[_PATTERNS] = known = {pattern: reason}
    own: Callable[[str], Any] | None = module.__dict__.get("__getattr__")

    def find(name: str) -> Any:
        if not name.startswith("__"):
            for one, why in known.items():
                if fnmatchcase(name, one):
                    where = f"'{module.__name__}'"
                    if _is_import(sys._getframe(1)):
                        raise ImportError(
                            f"cannot import name '{name}' from {where}: gazelle: it {why}",
                            name=module.__name__,
                        )
                    raise AttributeError(
                        f"module {where} has no attribute '{name}': gazelle: it {why}"
                    )
        if own is not None:
            return own(name)
        raise AttributeError(f"module '{module.__name__}' has no attribute '{name}'")

    module.__getattr__ = find  # type: ignore[method-assign]


def _refuse_keyword(thing: Any, keyword: str, reason: str) -> None:
    """Let a function or a class say why it does not take a keyword."""
    is_class = isinstance(thing, type)
    called: str = thing.__name__
    # Tuples take their values in __new__.
    maker = "__init__" if getattr(thing, "__init__", None) is not object.__init__ else "__new__"
    made: Any = getattr(thing, maker) if is_class else thing
    # A class may inherit the wrapper of its parent, which names the parent.
    refused_keywords = getattr(vars(thing).get(maker) if is_class else made, _KEYWORDS, None)
    if refused_keywords is not None:
        refused_keywords[keyword] = reason
        return
    refused = {keyword: reason}

    @wraps(made)
    def told(*arguments: Any, **keywords: Any) -> Any:
        for name in refused.keys() & keywords.keys():
            raise TypeError(
                f"{called}() got an unexpected keyword argument '{name}':"
                f" gazelle: it {refused[name]}"
            )
        return made(*arguments, **keywords)

    setattr(told, _KEYWORDS, refused)
    if is_class:
        setattr(thing, maker, told)
    else:
        _replace(thing, told)


def _replace(function: Any, told: Any) -> None:
    """Put a function's new form where its drop-in modules and classes have the old one."""
    owner: Any = sys.modules[function.__module__]
    for part in function.__qualname__.split(".")[:-1]:
        owner = getattr(owner, part)
    name: str = function.__name__
    setattr(owner, name, told)
    for module in list(sys.modules.values()):
        if getattr(module, "__dict__", {}).get(name) is function:
            setattr(module, name, told)


def _loaded(name: str) -> Any:
    """Return the module, class or function of a dotted name, or None if it is not loaded."""
    if name in sys.modules:
        return sys.modules[name]
    owner, _, last = name.rpartition(".")
    thing = _loaded(owner) if owner else None
    return None if thing is None else getattr_static(thing, last, None)


def _attach_placeholder(row: UnsupportedAttribute) -> None:
    owner, _, name = row.part.rpartition(".")
    if "(" in row.part:
        what, _, keyword = row.part.rstrip(")").partition("(")
        thing = _loaded(what)
        if thing is not None:
            _refuse_keyword(thing, keyword, row.reason)
        return
    thing = _loaded(owner)
    if isinstance(thing, ModuleType):
        _refuse_in_module(thing, name, row.reason)
    elif isinstance(thing, type) and not hasattr(thing, name):
        refusal = _Placeholder(row.reason)
        setattr(thing, name, refusal)
        refusal.__set_name__(thing, name)


def attach_placeholders(module: str) -> None:
    """Put the sentences on a drop-in module that was just imported, and on those it made."""
    for row in UNSUPPORTED_ATTRIBUTES:
        if row.part.startswith(f"{module}."):
            _attach_placeholder(row)
    for refused in UNSUPPORTED_MODULES:
        owner, _, name = refused.module.rpartition(".")
        thing = sys.modules.get(owner) if f"{owner}.".startswith(f"{module}.") else None
        if thing is not None and why_unsupported(refused.module):
            # What is one module here may be a package there.
            thing.__dict__.setdefault("__path__", [])
            _refuse_in_module(thing, name, refused.reason)


class _Loader(SourceFileLoader):
    def exec_module(self, module: ModuleType) -> None:
        super().exec_module(module)
        attach_placeholders(module.__name__)


class PlaceholderFinder:
    """Loads Gazelle's drop-in modules; it stands before Python's own finders."""

    def __init__(self) -> None:
        names = [row.part for row in UNSUPPORTED_ATTRIBUTES] + [
            row.module for row in UNSUPPORTED_MODULES
        ]
        self._packages = {name.partition(".")[0] for name in names}

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return the specification of a drop-in module, None for every other."""
        if fullname.partition(".")[0] not in self._packages:
            return None
        found = PathFinder.find_spec(fullname, path, target)
        if found is None or found.origin is None or _MODULES not in Path(found.origin).parents:
            return None
        return spec_from_file_location(
            fullname,
            found.origin,
            loader=_Loader(fullname, found.origin),
            submodule_search_locations=found.submodule_search_locations,
        )
