"""Zstandard: Python's own from 3.14 on, its backport before."""

from __future__ import annotations

from typing import Any

__all__ = ["ZSTD_MAGIC", "compress", "library"]

ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"


def compress(data: bytes) -> bytes:
    """Return one frame."""
    found: bytes = library().compress(data)
    return found


def library() -> Any:
    """Return the module."""
    try:
        from compression import zstd  # type: ignore[import-not-found]  # Python 3.14
    except ImportError:
        from backports import zstd
    return zstd
