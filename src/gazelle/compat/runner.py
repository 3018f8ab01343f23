"""``python -m gazelle.compat.runner SCRIPT args…``: a user's node as ``__main__``."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from types import ModuleType

from gazelle.compat.finder import install
from gazelle.compat.python2 import compile_source
from gazelle.graph.parent import end_with_parent
from gazelle.launch.environment import drop_in_folder

__all__ = ["main", "run_script"]


def main(words: list[str]) -> int:
    """Run the script named first with the rest as its arguments."""
    if not words:
        sys.stderr.write("usage: python -m gazelle.compat.runner SCRIPT [args…]\n")
        return 2
    end_with_parent()
    drop_ins = str(drop_in_folder())
    if drop_ins not in sys.path:
        sys.path.insert(1, drop_ins)
    install()
    return run_script(Path(words[0]), words)


def run_script(path: Path, argv: list[str]) -> int:
    """Execute a script as ``__main__``, as Python itself would; what it raises passes through."""
    try:
        source = path.read_bytes()
    except OSError as error:
        sys.stderr.write(f"cannot read '{path}': {error.strerror}\n")
        return 2
    code = compile_source(source, str(path))
    module = ModuleType("__main__")
    module.__file__ = str(path)
    module.__builtins__ = __builtins__  # type: ignore[attr-defined]
    sys.modules["__main__"] = module
    sys.argv = list(argv)
    sys.path[0] = os.path.realpath(path.parent)
    exec(code, module.__dict__)  # noqa: S102 - running the user's node is the purpose
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
