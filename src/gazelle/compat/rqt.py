"""Qt and rqt, which user code may import and Gazelle does not have.

Where they are installed, they are what is imported; else one error says what to do.
"""

from __future__ import annotations

import importlib
import importlib.machinery
import sys
from importlib.util import module_from_spec
from pathlib import Path

__all__ = ["installed_or_refused"]

_FOLDER = Path(__file__).parent / "modules"
_TEXT = (
    "'{name}' is part of rqt, whose plug-ins draw with Qt; Gazelle's windows are panels of a page "
    "in the browser\n"
    "  fix: write the window as a panel, a Python class with a list of widgets "
    "(docs: Write a panel). `gazelle studio` lists this plug-in among its panels; opening it "
    "there shows which of its widgets becomes what, and a panel to begin with\n"
    "  where rqt and Qt are installed, they are found and used"
)


def installed_or_refused(name: str) -> None:
    """Put the installed package in the place of the drop-in that asks.

    Args:
        name: of the package; the caller is its drop-in.

    Raises:
        ImportError: it is not installed.
    """
    top = name.partition(".")[0]
    folders = [folder for folder in sys.path if Path(folder or ".").resolve() != _FOLDER.resolve()]
    spec = importlib.machinery.PathFinder.find_spec(top, folders)
    if spec is None or spec.loader is None:
        raise ImportError(_TEXT.format(name=name), name=name)
    module = module_from_spec(spec)
    sys.modules[top] = module
    spec.loader.exec_module(module)
