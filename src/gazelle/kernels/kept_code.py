"""Where the machine code of kernels is kept, when it is stale, and whether it is trusted.

It lies in ``GAZELLE_KERNEL_CACHE`` where that is set, else in ``__pycache__`` beside the module,
else below the user's cache. A folder that is not this user's, or that others may write to, is
passed over: what is loaded from it runs in this process.

What is kept says what it was made of: the functions, constants and named tuples it takes in, of
whatever module. It is stale where one of them has changed.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import pickle
import sys
from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

from gazelle.cache_folders import is_trusted, own_cache, own_folder, tell_not_kept
from gazelle.kernels.kernel_types import KernelType
from gazelle.kernels.source import KernelSource, Use, digest_of, fingerprint

__all__ = ["VARIABLE", "KeptCode", "file_of", "folder_of", "keep", "kept"]

VARIABLE = "GAZELLE_KERNEL_CACHE"
_DAMAGED = (
    AttributeError, EOFError, ImportError, LookupError, TypeError, ValueError, pickle.PickleError,
)  # fmt: skip
"""What reading half a file, or of types that have another name now, may raise."""

_folders: dict[Path, Path | None] = {}


class KeptCode(NamedTuple):
    """What is kept of a kernel for arguments of some types.

    Attributes:
        own: digest of the kernel's function.
        uses: what else it is made of.
        result: type of what it returns.
        name: of its entry.
        content: the object file.
    """

    own: str
    uses: tuple[Use, ...]
    result: KernelType
    name: str
    content: bytes


def folder_of(source: KernelSource) -> Path | None:
    """Return where a kernel is kept, None where it is not.

    The folder is the same as long as the process runs.
    """
    file = Path(source.function.__code__.co_filename)
    if file.parent not in _folders:
        _folders[file.parent] = _chosen(file.parent)
    return _folders[file.parent]


def _chosen(parent: Path) -> Path | None:
    digest = hashlib.sha256(str(parent).encode(errors="surrogateescape")).hexdigest()[:16]
    name = f"{parent.name}_{digest}"
    if named := os.environ.get(VARIABLE):
        folder = own_folder(Path(named), VARIABLE)
        if folder is not None:
            return folder / name
    else:
        beside = parent / "__pycache__"
        with contextlib.suppress(OSError):
            beside.mkdir(exist_ok=True)
        if is_trusted(beside) and os.access(beside, os.W_OK | os.X_OK):
            return beside
    own = own_cache("kernels")
    return None if own is None else own / name


def file_of(source: KernelSource, types: tuple[KernelType, ...], machine: str) -> Path | None:
    """Return the file of a kernel for arguments of some types, None where it is not kept."""
    folder = folder_of(source)
    if folder is None:
        return None
    words = (_compiler(), sys.version_info[:2], machine, [_words(kind) for kind in types])
    digest = hashlib.sha256(repr(words).encode()).hexdigest()[:16]
    stem = Path(source.function.__code__.co_filename).stem
    return folder / f"{stem}.{source.function.__qualname__}-{digest}.kernel"


@functools.cache
def _compiler() -> str:
    """Return what changes where kernels are compiled in another way."""
    files = sorted(Path(__file__).parent.glob("*.py"))
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()


def _words(kind: object) -> object:
    # A class's own representation may have its address.
    if isinstance(kind, type):
        return f"{kind.__module__}.{kind.__qualname__}{getattr(kind, '_fields', '')}"
    if isinstance(kind, tuple):
        return [type(kind).__name__, *map(_words, kind)]
    return kind


def kept(file: Path, source: KernelSource) -> KeptCode | None:
    """Return what is kept in a file, None where there is nothing that can be used."""
    try:
        # The folder is this user's alone.
        found = pickle.loads(file.read_bytes())  # noqa: S301
        if isinstance(found, KeptCode) and found.own == digest_of(source) and _is_fresh(found.uses):
            return found
    except (OSError, *_DAMAGED):
        pass
    return None


def _is_fresh(uses: Iterable[Use]) -> bool:
    return all(
        fingerprint(getattr(import_module(use.module), use.name)) == use.fingerprint for use in uses
    )


def keep(file: Path, code: KeptCode) -> None:
    """Keep code in a file; where that fails it is told, and the kernel works still."""
    spare = file.with_name(f"{file.name}.{os.getpid()}")
    try:
        file.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        spare.write_bytes(pickle.dumps(code))
        spare.replace(file)
    except OSError as error:
        with contextlib.suppress(OSError):
            spare.unlink()
        variable = VARIABLE if os.environ.get(VARIABLE) else ""
        tell_not_kept("compiled kernels", file.parent, error, variable)
