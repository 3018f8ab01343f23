"""Where the machine code of kernels is kept, when it is stale, and whether it is trusted.

It lies in ``NUMBA_CACHE_DIR`` where that is set, else in ``__pycache__`` beside the module, else
below the user's cache. A folder that is not this user's, or that others may write to, is passed
over: what is loaded from it runs in this process.

What numba has kept for a kernel holds the machine code of the kernels it calls, and the places of
fields in the records it is given or makes. Numba asks only whether the kernel's own file has
changed, and for the names of the records it is given; here it asks for the files of the kernels
that are called and of the records that are made, and for the names of fields, too.

Importing this imports numba.
"""

from __future__ import annotations

import contextlib
import hashlib
import inspect
import os
import pickle
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from numba.core import config
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile

from gazelle import kernel_links
from gazelle.cache_folders import is_trusted, own_cache, own_folder, tell_not_kept
from gazelle.kernel_links import fields_of

__all__ = ["KernelCache", "cache_folder_of"]

_VARIABLE = "NUMBA_CACHE_DIR"
_DAMAGED = (AttributeError, EOFError, ImportError, LookupError, ValueError, pickle.PickleError)
"""What reading half a file, or records that have another name now, may raise."""
_HOW_COMPILED = 2
"""Raised where kernels are compiled in another way, which no source of theirs shows."""

_stamps: dict[Any, set[Any]] = {}
"""Of each kernel: the stamps of its file and of those of what it calls and of records it makes."""
_folders: dict[Path, Path | None] = {}


def cache_folder_of(file: Path) -> Path | None:
    """Return where the kernels of a source file are kept, None where they are not.

    The folder is the same as long as the process runs.
    """
    parent = file.parent
    if parent not in _folders:
        _folders[parent] = _chosen(file)
    return _folders[parent]


def _chosen(file: Path) -> Path | None:
    digest = hashlib.sha256(str(file.parent).encode(errors="surrogateescape")).hexdigest()[:16]
    name = f"{file.parent.name}_{digest}"
    if config.CACHE_DIR:
        named = own_folder(Path(config.CACHE_DIR), _VARIABLE)
        if named is not None:
            return named / name
    else:
        beside = file.parent / "__pycache__"
        with contextlib.suppress(OSError):
            beside.mkdir(exist_ok=True)
        if is_trusted(beside) and os.access(beside, os.W_OK | os.X_OK):
            return beside
    own = own_cache("kernels")
    return None if own is None else own / name


class _Locator:
    """Where the kernels of a file are kept, as numba asks for it."""

    def __init__(self, file: Path, line: int) -> None:
        self._line = line
        self.file = file
        # Numba names it where it tells of what cannot be kept.
        self._py_file = str(file)

    def get_cache_path(self) -> str:
        return str(cache_folder_of(self.file) or "")

    def ensure_cache_path(self) -> None:
        Path(self.get_cache_path()).mkdir(mode=0o700, parents=True, exist_ok=True)

    def get_source_stamp(self) -> bytes:
        return _digest(self.file)

    def get_disambiguator(self) -> str:
        return str(self._line)


@cache
def _digest(file: Path) -> bytes:
    return hashlib.sha256(file.read_bytes()).digest()


class _Packing(CompileResultCacheImpl):  # type: ignore[misc]
    """How a kernel is written to a file and read again."""

    def __init__(self, py_func: Any) -> None:
        self._lineno = py_func.__code__.co_firstlineno
        file = Path(inspect.getfile(py_func))
        self._locator = _Locator(file, self._lineno)
        self._filename_base = self.get_filename_base(f"{file.stem}.{py_func.__qualname__}", "")

    def reduce(self, cres: Any) -> Any:
        return kernel_links.callees_so_far(), super().reduce(cres)

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        callees, packed = payload
        kernel_links.require(callees)
        return super().rebuild(target_context, packed)


class _File(IndexDataCacheFile):  # type: ignore[misc]
    """The files of one kernel; what is damaged counts as not there."""

    def _load_index(self) -> Any:
        try:
            return super()._load_index()
        except (OSError, *_DAMAGED):
            return {}

    def load(self, key: Any) -> Any:
        try:
            return super().load(key)
        except (OSError, *_DAMAGED):
            return None


class KernelCache(FunctionCache):  # type: ignore[misc]
    """Numba's cache of one kernel.

    Attributes:
        on_miss: called before the kernel is compiled because it is not kept.
    """

    _impl_class = _Packing

    def __init__(self, py_func: Any, kernel: Any, on_miss: Callable[[], None]) -> None:
        """Keep a kernel.

        Args:
            py_func: its function.
            kernel: numba's dispatcher.
            on_miss: see above.
        """
        super().__init__(py_func)
        self.on_miss = on_miss
        self._cache_file = _File(
            self._cache_path, self._impl.filename_base, self._stamp_of(kernel, py_func)
        )
        if not self._cache_path:
            self.disable()

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return what is kept for a signature, None where nothing is."""
        try:
            found = super().load_overload(sig, target_context)
        except _DAMAGED:
            found = None
        if found is None:
            self.on_miss()
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled; where that fails it is told, and the kernel works still."""
        try:
            super().save_overload(sig, data)
        except OSError as error:
            folder = Path(self._cache_path)
            variable = _VARIABLE if config.CACHE_DIR else ""
            tell_not_kept("compiled kernels", folder, error, variable)

    def _stamp_of(self, kernel: Any, function: Any) -> Any:
        """Return what changes where a file has of what a kernel is, calls or makes."""
        stamps = {self._impl.locator.get_source_stamp()}
        for name in function.__code__.co_names:
            used = function.__globals__.get(name)
            if hasattr(used, "py_func"):
                stamps |= _stamps.get(used, set())
            elif isinstance(used, type) and hasattr(used, "_fields"):
                stamps.add(_digest(Path(inspect.getfile(used))))
        _stamps[kernel] = stamps
        return tuple(sorted(stamps))

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        """Return what a kept kernel is known by: also the order of its records' fields."""
        key = super()._index_key(sig, codegen)
        return (*key, fields_of(getattr(sig, "args", sig)), _HOW_COMPILED)
