"""Machine code of this processor: made of LLVM's language, loaded, and called.

Importing this imports llvmlite.
"""

from __future__ import annotations

import ctypes
import functools
import sys
from collections.abc import Callable, Mapping
from typing import Any

import llvmlite
import llvmlite.binding as llvm

from gazelle.kernels.python_entry import SYMBOLS

__all__ = ["callable_of", "load", "machine", "object_code"]

_METH_FASTCALL = 0x80
_OF_MATHEMATICS = (
    "sqrt", "sin", "cos", "exp", "log", "log2", "floor", "ceil", "rint", "fabs", "trunc", "pow",
    "copysign", "fmod", "tan", "asin", "acos", "atan", "atan2",
)  # fmt: skip
_SINGLE = tuple(f"{name}f" for name in _OF_MATHEMATICS[:14])

_kept: list[Any] = []
"""What must live as long as the process: Python holds only its address."""


def machine() -> str:
    """Return what the code is made for, and by what."""
    features = llvm.get_host_cpu_features().flatten()
    words = (llvmlite.__version__, llvm.get_process_triple(), llvm.get_host_cpu_name(), features)
    return " ".join(words)


@functools.cache
def _target_machine() -> Any:
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    target = llvm.Target.from_triple(llvm.get_process_triple())
    return target.create_target_machine(
        cpu=llvm.get_host_cpu_name(),
        features=llvm.get_host_cpu_features().flatten(),
        opt=3,
        codemodel="jitdefault",
        jit=True,
    )


@functools.cache
def _engine() -> Any:
    for name, address in SYMBOLS.items():
        llvm.add_symbol(name, address)
    if sys.platform == "win32":
        _name_mathematics()
    return llvm.create_mcjit_compiler(llvm.parse_assembly(""), _target_machine())


def _name_mathematics() -> None:
    """Say where the C library is: programs of this system do not tell it by name."""
    library = ctypes.CDLL("ucrtbase")
    for name in (
        *_OF_MATHEMATICS,
        *_SINGLE,
        "malloc",
        "calloc",
        "free",
        "memset",
        "memcpy",
        "strcmp",
        "perror",
        "abort",
    ):
        found = getattr(library, name, None)
        if found is not None:
            llvm.add_symbol(name, ctypes.cast(found, ctypes.c_void_p).value)


def object_code(text: str) -> bytes:
    """Return the optimised machine code of a program, an object file."""
    machine = _target_machine()
    module = llvm.parse_assembly(text)
    module.triple = llvm.get_process_triple()
    module.data_layout = str(machine.target_data)
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization = True
    builder = llvm.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    return bytes(machine.emit_object(module))


def load(content: bytes, symbols: Mapping[str, int]) -> None:
    """Load an object file, for good.

    Args:
        content: of the file.
        symbols: where what it calls or asks for lies, besides what all do.
    """
    engine = _engine()
    for name, address in symbols.items():
        llvm.add_symbol(name, address)
    engine.add_object_file(llvm.ObjectFileRef.from_data(content))
    engine.finalize_object()


class _Method(ctypes.Structure):
    """Python's ``PyMethodDef``."""

    _fields_ = (
        ("name", ctypes.c_char_p),
        ("address", ctypes.c_void_p),
        ("flags", ctypes.c_int),
        ("doc", ctypes.c_char_p),
    )


def callable_of(name: str) -> Callable[..., Any]:
    """Return Python's function of a loaded entry.

    Raises:
        ImportError: there is none of this name in what was loaded.
    """
    address = _engine().get_function_address(name)
    if not address:
        raise ImportError(f"there is no {name} in the object file")
    method = _Method(name.encode(), address, _METH_FASTCALL, None)
    _kept.append(method)
    make = ctypes.pythonapi.PyCFunction_NewEx
    make.restype = ctypes.py_object
    make.argtypes = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_void_p)
    function: Callable[..., Any] = make(ctypes.addressof(method), None, None)
    return function
