"""Tells which names of an original package are missing here; runs as a node of a launch does."""

import inspect
import json
import re
import sys
from importlib import import_module
from pathlib import Path

LINE = re.compile(r"(?P<name>[\w.]+)(?:\((?P<words>[\w,]*)\))? (?P<where>[KMNHJR]*)$")


def found(name):
    """Return what a dotted name means: the longest module, then attributes."""
    parts = name.split(".")
    error = None
    for count in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(parts[:count]))
        except ModuleNotFoundError as missing:
            error = error or missing
            continue
        try:
            for part in parts[count:]:
                thing = getattr(thing, part)
        except AttributeError as missing:
            raise error if error and "gazelle:" in str(error) else missing from None
        return thing
    raise error


def missing_words(thing, words):
    """Return the keyword arguments that are not taken."""
    try:
        parameters = inspect.signature(thing).parameters.values()
    except (TypeError, ValueError):
        return []
    if any(one.kind is one.VAR_KEYWORD for one in parameters):
        return []
    makers = (thing.__init__, thing.__new__) if inspect.isclass(thing) else (thing,)
    own = {one.name for one in parameters}
    own.update(*(getattr(maker, "__refused_words__", ()) for maker in makers))
    return [word for word in words if word and word not in own]


def has_attribute(name):
    """Return whether a class sets an attribute in its own code, or declares it."""
    owner, _, attribute = name.rpartition(".")
    try:
        thing = found(owner)
    except (ImportError, AttributeError):
        return False
    if not inspect.isclass(thing):
        return False
    for one in thing.__mro__:
        if attribute in getattr(one, "__annotations__", {}):
            return True
        try:
            source = inspect.getsource(one)
        except (OSError, TypeError):
            continue
        if re.search(rf"self\.{attribute}\b[^=\n]*=", source):
            return True
    return False


def missing_in(text):
    """Yield what is neither there nor refused with a sentence."""
    for line in text.splitlines():
        match = LINE.match(line)
        name = match["name"]
        try:
            thing = found(name)
        except (ImportError, AttributeError) as error:
            if "gazelle:" not in str(error) and not has_attribute(name):
                yield name
            continue
        if match["words"] is not None:
            yield from (
                f"{name}({word})" for word in missing_words(thing, match["words"].split(","))
            )


found_missing = []
for path in sys.argv[1:]:
    found_missing += missing_in(Path(path).read_text(encoding="utf-8"))
print("RESULT" + json.dumps(found_missing))
