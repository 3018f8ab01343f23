"""``python -m gazelle.compat.script_runner [--entry FUNCTION] SCRIPT args…``: a user's node."""

from __future__ import annotations

import os
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType, TracebackType

from gazelle.process_lifetime import (
    collect_garbage_rarely,
    end_at_interrupts,
    end_with,
    end_with_parent,
    raise_interrupts,
)

__all__ = ["main", "run_script"]


def main(argv: list[str]) -> int:
    """Run the script named first with the rest as its arguments."""
    if not argv:
        sys.stderr.write("usage: python -m gazelle.compat.script_runner SCRIPT [args…]\n")
        return 2
    end_at_interrupts()
    collect_garbage_rarely()
    from gazelle.compat.import_hooks import install
    from gazelle.launch.environment import drop_in_folder

    end_with_parent()
    sys.excepthook = _tell
    drop_ins = str(drop_in_folder())
    if drop_ins not in sys.path:
        sys.path.insert(1, drop_ins)
    install()
    function = ""
    if argv[0] == "--entry":
        # One of several console scripts whose functions are in one file.
        function, argv = argv[1], argv[2:]
    path = Path(argv[0])
    entry = _entry_point(path, function)
    raise_interrupts()
    return run_script(path, argv) if entry is None else _run_entry_point(*entry, argv)


def run_script(path: Path, argv: list[str]) -> int:
    """Execute a script as ``__main__``, as Python itself would; what it raises passes through."""
    try:
        source = path.read_bytes()
    except OSError as error:
        sys.stderr.write(f"cannot read '{path}': {error.strerror}\n")
        return 2
    from gazelle.compat.python2 import compile_source

    code = compile_source(source, str(path))
    module = ModuleType("__main__")
    module.__file__ = str(path)
    module.__builtins__ = __builtins__  # type: ignore[attr-defined]
    sys.modules["__main__"] = module
    sys.argv = list(argv)
    sys.path[0] = os.path.realpath(path.parent)
    exec(code, module.__dict__)  # noqa: S102 - running the user's node is the purpose
    return 0


def _tell(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """Print a traceback that begins in the user's file, as when Python itself runs it."""
    ours = str(Path(__file__).parents[1])
    first = trace
    while first is not None and _file(first).startswith((ours, "<frozen")):
        first = first.tb_next
    sys.__excepthook__(kind, error.with_traceback(first or trace), first or trace)


def _file(trace: TracebackType) -> str:
    return trace.tb_frame.f_code.co_filename


def _entry_point(path: Path, wanted: str = "") -> tuple[Path, str, str] | None:
    """Return folder, module and function of a ``console_scripts`` entry that means this file.

    Of several functions in one file it is `wanted`, ``main``, or the first.
    """
    file = path.absolute()
    root = next((one for one in file.parents if (one / "package.xml").is_file()), None)
    if root is None:
        return None
    from gazelle.workspace.entry_points import console_scripts

    for folder in (root, root / "src"):
        if folder in file.parents:
            module = ".".join(file.relative_to(folder).with_suffix("").parts)
            targets = (target.partition(":") for target in console_scripts(root).values())
            functions = [function.strip() for name, _, function in targets if name == module]
            if functions:
                usual = "main" if "main" in functions else functions[0]
                return folder, module, wanted or usual
    return None


def _run_entry_point(folder: Path, module: str, function: str, argv: list[str]) -> int:
    """Call a package's function, as the script that ``pip`` would install does."""
    sys.argv = list(argv)
    sys.path[0] = str(folder)
    found = getattr(import_module(module), function)()
    return found if isinstance(found, int) else 0


if __name__ == "__main__":
    end_with(lambda: main(sys.argv[1:]))
