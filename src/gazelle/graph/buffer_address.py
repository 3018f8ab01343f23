"""Where a buffer of Python lies in memory, for those who read it without Python."""

from __future__ import annotations

import ctypes

__all__ = ["address_of"]


class _View(ctypes.Structure):
    """``Py_buffer`` of Python's C API."""

    _fields_ = (
        ("buf", ctypes.c_void_p),
        ("obj", ctypes.c_void_p),
        ("len", ctypes.c_ssize_t),
        ("itemsize", ctypes.c_ssize_t),
        ("readonly", ctypes.c_int),
        ("ndim", ctypes.c_int),
        ("format", ctypes.c_char_p),
        ("shape", ctypes.c_void_p),
        ("strides", ctypes.c_void_p),
        ("suboffsets", ctypes.c_void_p),
        ("internal", ctypes.c_void_p),
    )


def address_of(buffer: object) -> int:
    """Return the address of a buffer's first byte; whoever uses it keeps the buffer."""
    view = _View()
    api = ctypes.pythonapi
    if api.PyObject_GetBuffer(ctypes.py_object(buffer), ctypes.byref(view), 0) != 0:
        raise TypeError("this has no memory of its own")
    found = int(view.buf or 0)
    api.PyBuffer_Release(ctypes.byref(view))
    return found
