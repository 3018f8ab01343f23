"""What reading a description brings into the process."""

from __future__ import annotations

import subprocess
import sys

from tests.patience import stretched


def test_reading_a_plain_file_brings_no_module_that_only_xacro_needs() -> None:
    names = ("collada", "scipy", "xacro", "xml.dom.minidom", "yaml")
    code = (
        f"import gazelle.description.loader, sys; print([n for n in {names} if n in sys.modules])"
    )
    words = [sys.executable, "-c", code]
    found = subprocess.run(words, capture_output=True, text=True, check=True, timeout=stretched())
    assert found.stdout == "[]\n"
