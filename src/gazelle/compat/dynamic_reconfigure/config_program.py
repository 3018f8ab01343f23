"""``python -m gazelle.compat.dynamic_reconfigure.config_program FILE``: what a ``.cfg`` file says.

Prints one JSON object: ``package``, ``name``, ``group`` (parameters and groups below) and
``constants``. The file is a program of the user's package, so it runs in a process of its own.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run the file that is named, and print what it generates."""
    from gazelle.compat.dynamic_reconfigure import parameter_generator
    from gazelle.compat.import_hooks import install
    from gazelle.compat.script_runner import run_script
    from gazelle.launch.environment import drop_in_folder

    sys.path.insert(1, str(drop_in_folder()))
    install()
    output, sys.stdout = sys.stdout, sys.stderr  # what the program prints is not what it says
    try:
        code = run_script(Path(argv[0]), [argv[0]])
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    if code:
        return code
    if not parameter_generator.FINISHED:
        sys.stderr.write(f"'{argv[0]}' does not call generate() of its ParameterGenerator\n")
        return 1
    generator, name = parameter_generator.FINISHED[-1]
    said = {
        "package": generator.package,
        "name": name,
        "group": generator.group.to_dict(),
        "constants": generator.constants,
    }
    output.write(json.dumps(said) + "\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
