"""Python as it starts in a shell of ``gazelle env``."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import gazelle.compat

MODULES = Path(gazelle.compat.__file__).parent / "modules"


def _start(folder: Path, own_site: str, program: str) -> subprocess.CompletedProcess[str]:
    (folder / "sitecustomize.py").write_text(own_site)
    paths = os.pathsep.join([str(MODULES), str(folder)])
    words = [sys.executable, "-c", program]
    environ = {**os.environ, "PYTHONPATH": paths}
    # Behind "&" in a script the tests are started with SIGINT ignored, which children inherit.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return subprocess.run(words, capture_output=True, text=True, env=environ, check=False)
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_interrupt_while_python_starts_leaves_no_traceback(tmp_path: Path) -> None:
    done = _start(tmp_path, "import os\nos.kill(os.getpid(), 2)\n", "print('too far')")
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_programs_have_python_s_own_interrupt_handler(tmp_path: Path) -> None:
    program = "import signal; print(signal.getsignal(2) is signal.default_int_handler)"
    assert _start(tmp_path, "", program).stdout == "True\n"


def test_a_handler_of_the_user_s_own_site_stays(tmp_path: Path) -> None:
    own = "import signal\nsignal.signal(2, signal.SIG_IGN)\n"
    program = "import signal; print(signal.getsignal(2) is signal.SIG_IGN)"
    assert _start(tmp_path, own, program).stdout == "True\n"
