"""Makes message packages importable in every Python of a `gazelle env` shell."""

import _signal

# Ctrl-C while Python itself still starts ends it without "Fatal Python error" and a traceback.
_GIVEN = _signal.getsignal(_signal.SIGINT)
if _GIVEN is _signal.default_int_handler:
    _signal.signal(_signal.SIGINT, _signal.SIG_DFL)

import importlib.machinery
import importlib.util
import sys
from pathlib import Path

_HERE = str(Path(__file__).parent)


def _chain():
    """Run the sitecustomize that this one stands before, if there is one."""
    places = [place for place in sys.path if place and str(Path(place)) != _HERE]
    spec = importlib.machinery.PathFinder.find_spec("sitecustomize", places)
    if spec is not None and spec.loader is not None:
        spec.loader.exec_module(importlib.util.module_from_spec(spec))


_chain()
if importlib.util.find_spec("gazelle") is not None:
    from gazelle.compat.import_hooks import install

    install()

if _signal.getsignal(_signal.SIGINT) == _signal.SIG_DFL:
    _signal.signal(_signal.SIGINT, _GIVEN)
