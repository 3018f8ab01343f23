"""How the server keeps memory."""

from __future__ import annotations

import platform
import sys

from gazelle.graph.glibc_malloc import keep_freed_memory


def test_glibc_alone_can_be_told_to_keep_memory() -> None:
    is_glibc = sys.platform == "linux" and platform.libc_ver()[0] == "glibc"
    assert keep_freed_memory() is is_glibc
