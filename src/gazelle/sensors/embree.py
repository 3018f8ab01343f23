"""Embree 4 through ctypes: finding the library, its functions, scenes of instances.

The library is the one inside the ``embreex`` wheel; nothing of embreex itself is imported.
Names and layouts are those of Embree's C API (``rtcore.h``, version 4).
"""

from __future__ import annotations

import ctypes
import importlib.util
import weakref
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.errors import GazelleError

__all__ = [
    "NOTHING",
    "PACKET",
    "PACKET_BYTES",
    "EmbreeError",
    "InstancedScene",
    "SubScene",
    "device",
    "find_library",
    "library",
    "packet_buffer",
    "sub_scene",
]

PACKET = 16
"""Rays per packet."""

PACKET_ROWS = 24
"""Rows of 16 words that hold one RTCRayHit16 (21 are used, the rest keeps packets aligned)."""

PACKET_BYTES = PACKET_ROWS * PACKET * 4

NOTHING = 0xFFFFFFFF
"""RTC_INVALID_GEOMETRY_ID."""

_TRIANGLE, _SPHERE_POINT, _INSTANCE = 0, 50, 121
_INDEX_BUFFER, _VERTEX_BUFFER = 0, 1
_UINT3, _FLOAT3, _FLOAT4, _FLOAT4X4_COLUMN_MAJOR = 0x5003, 0x9003, 0x9004, 0x9244
_DYNAMIC, _ROBUST = 1, 4
_EVERY_RAY = 0xFFFFFFFF
_LIBRARY_PATTERNS = ("libembree4*.so*", "libembree4*.dylib", "embree4*.dll")
_TBB_PATTERNS = ("libtbb*.so*", "libtbb*.dylib", "tbb*.dll")


class EmbreeError(GazelleError):
    """Embree cannot be loaded, or refused what it was given."""


_P, _U, _I, _S = ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_size_t
_FUNCTIONS: dict[str, tuple[Any, tuple[Any, ...]]] = {
    "rtcNewDevice": (_P, (ctypes.c_char_p,)),
    "rtcGetDeviceError": (_I, (_P,)),
    "rtcNewScene": (_P, (_P,)),
    "rtcSetSceneFlags": (None, (_P, _I)),
    "rtcCommitScene": (None, (_P,)),
    "rtcReleaseScene": (None, (_P,)),
    "rtcNewGeometry": (_P, (_P, _I)),
    "rtcSetNewGeometryBuffer": (_P, (_P, _I, _U, _I, _S, _S)),
    "rtcSetGeometryInstancedScene": (None, (_P, _P)),
    "rtcSetGeometryTransform": (None, (_P, _U, _I, _P)),
    "rtcSetGeometryMask": (None, (_P, _U)),
    "rtcCommitGeometry": (None, (_P,)),
    "rtcAttachGeometryByID": (None, (_P, _P, _U)),
    "rtcReleaseGeometry": (None, (_P,)),
    "rtcIntersect16": (None, (_P, _P, _P, _P)),
}


@dataclass(frozen=True, slots=True)
class Library:
    """The loaded library.

    Attributes:
        path: the file.
        functions: Embree's functions by name; a call lets other Python threads run.
        quick: the same functions for calls of microseconds, which keep the interpreter lock:
            taking it back after each would wait for other threads' turns.
    """

    path: Path
    functions: Any
    quick: Any


def find_library() -> tuple[Path, tuple[Path, ...]]:
    """Return Embree's shared library and the libraries to load before it.

    Wheels keep them in ``embreex.libs`` (Linux, Windows) or ``embreex/.dylibs`` (macOS).

    Raises:
        EmbreeError: the wheel is not installed, or holds no Embree 4.
    """
    spec = importlib.util.find_spec("embreex")
    if spec is None or spec.origin is None:
        raise EmbreeError(
            "ray-traced sensors need Embree, and the package 'embreex' is not installed\n"
            "  install it with: pip install 'embreex>=4.4'\n"
            "  (it has wheels for Linux x86_64, macOS and Windows)"
        )
    package = Path(spec.origin).parent
    folders = (package.with_name("embreex.libs"), package / ".dylibs", package)
    for folder in folders:
        found = _first(folder, _LIBRARY_PATTERNS)
        if found:
            return found[0], tuple(_first(folder, _TBB_PATTERNS))
    places = "\n".join(f"    {folder}" for folder in folders)
    raise EmbreeError(
        "the installed 'embreex' carries no Embree 4 library\n"
        f"  looked in:\n{places}\n"
        "  install a newer one with: pip install --force-reinstall 'embreex>=4.4'"
    )


def _first(folder: Path, patterns: tuple[str, ...]) -> list[Path]:
    for pattern in patterns:
        found = sorted(folder.glob(pattern)) if folder.is_dir() else []
        if found:
            return found
    return []


@cache
def library() -> Library:
    """Load Embree once per process.

    Raises:
        EmbreeError: it is missing or this machine's loader refuses it.
    """
    path, needed_first = find_library()
    try:
        for item in needed_first:
            ctypes.CDLL(str(item), mode=ctypes.RTLD_GLOBAL)
        loaded, quick = ctypes.CDLL(str(path)), ctypes.PyDLL(str(path))
        for name, (result, arguments) in _FUNCTIONS.items():
            for function in (getattr(loaded, name), getattr(quick, name)):
                function.restype, function.argtypes = result, list(arguments)
    except (OSError, AttributeError) as error:
        raise EmbreeError(
            f"Embree cannot be loaded from {path}: {error}\n"
            "  reinstall it with: pip install --force-reinstall 'embreex>=4.4'"
        ) from error
    return Library(path, loaded, quick)


@cache
def device() -> int:
    """Return the process's Embree device: one building thread, so that trees are repeatable.

    Raises:
        EmbreeError: the device cannot be made.
    """
    handle = library().functions.rtcNewDevice(b"threads=1,set_affinity=0")
    if not handle:
        raise EmbreeError("Embree could not make a device on this processor")
    return int(handle)


def check_device() -> None:
    """Raise what Embree complained about since the last check.

    Raises:
        EmbreeError: with Embree's error number (``RTCError``).
    """
    code = library().functions.rtcGetDeviceError(device())
    if code:
        raise EmbreeError(f"Embree refused the scene (RTCError {code})")


class SubScene:
    """A committed scene in its own frame, shared by all its instances.

    Attributes:
        handle: ``RTCScene``, an address.
    """

    def __init__(self, geometries: list[int]) -> None:
        rtc = library().functions
        self.handle = int(rtc.rtcNewScene(device()))
        rtc.rtcSetSceneFlags(self.handle, _ROBUST)
        for number, geometry in enumerate(geometries):
            # Embree 4 shows geometry only to rays with bit 0 unless told otherwise.
            rtc.rtcSetGeometryMask(geometry, _EVERY_RAY)
            rtc.rtcCommitGeometry(geometry)
            rtc.rtcAttachGeometryByID(self.handle, geometry, number)
            rtc.rtcReleaseGeometry(geometry)
        rtc.rtcCommitScene(self.handle)
        check_device()
        weakref.finalize(self, rtc.rtcReleaseScene, self.handle).atexit = False


def sub_scene(
    triangles: Sequence[tuple[NDArray[np.float32], NDArray[np.int32]]] = (),
    spheres: NDArray[np.float32] | None = None,
) -> SubScene:
    """Build a scene of triangle meshes and exact spheres.

    Args:
        triangles: vertices (N, 3) in metres and faces (M, 3) of each part; part i gets
            ``geomID`` i.
        spheres: (K, 4) x, y, z, radius in metres; they share the ``geomID`` after the last part.
    """
    geometries = []
    rtc = library().functions
    for vertices, faces in triangles:
        geometry = rtc.rtcNewGeometry(device(), _TRIANGLE)
        _fill(geometry, _VERTEX_BUFFER, _FLOAT3, np.ascontiguousarray(vertices, np.float32))
        _fill(geometry, _INDEX_BUFFER, _UINT3, np.ascontiguousarray(faces, np.uint32))
        geometries.append(int(geometry))
    if spheres is not None:
        geometry = rtc.rtcNewGeometry(device(), _SPHERE_POINT)
        _fill(geometry, _VERTEX_BUFFER, _FLOAT4, np.ascontiguousarray(spheres, np.float32))
        geometries.append(int(geometry))
    return SubScene(geometries)


def _fill(geometry: int, buffer: int, layout: int, values: NDArray[Any]) -> None:
    stride = values.shape[1] * 4
    address = library().functions.rtcSetNewGeometryBuffer(
        geometry, buffer, 0, layout, stride, len(values)
    )
    if not address:
        check_device()
        raise EmbreeError("Embree gave no memory for a mesh")
    ctypes.memmove(address, values.ctypes.data, values.nbytes)


class InstancedScene:
    """A scene of moving instances of sub-scenes; ``instID`` is the instance's number.

    Attributes:
        handle: ``RTCScene``, an address; ray functions take it.
    """

    def __init__(
        self,
        sub_scenes: list[SubScene],
        matrices: NDArray[np.float32],
        masks: list[int],
    ) -> None:
        """Build and commit.

        Args:
            sub_scenes: what each instance shows.
            matrices: (N, 4, 4) ``T_world_instance``, scaling allowed.
            masks: 32-bit visibility mask of each instance, tested against a ray's mask.
        """
        rtc = library().quick
        self.handle = int(rtc.rtcNewScene(device()))
        rtc.rtcSetSceneFlags(self.handle, _DYNAMIC | _ROBUST)
        self._sub_scenes = tuple(sub_scenes)
        self._geometries: list[int] = []
        for number, sub_scene in enumerate(sub_scenes):
            geometry = int(rtc.rtcNewGeometry(device(), _INSTANCE))
            rtc.rtcSetGeometryInstancedScene(geometry, sub_scene.handle)
            rtc.rtcSetGeometryMask(geometry, masks[number])
            self._geometries.append(geometry)
            self._place(geometry, matrices[number])
            rtc.rtcAttachGeometryByID(self.handle, geometry, number)
            rtc.rtcReleaseGeometry(geometry)
        rtc.rtcCommitScene(self.handle)
        check_device()
        weakref.finalize(self, rtc.rtcReleaseScene, self.handle).atexit = False

    def move(self, numbers: NDArray[np.intp], matrices: NDArray[np.float32]) -> None:
        """Move instances and make the scene ready for rays again.

        Args:
            numbers: the instances that moved.
            matrices: (N, 4, 4) ``T_world_instance`` of all instances.
        """
        for number in numbers.tolist():
            self._place(self._geometries[number], matrices[number])
        library().quick.rtcCommitScene(self.handle)

    def _place(self, geometry: int, matrix: NDArray[np.float32]) -> None:
        rtc = library().quick
        columns = np.ascontiguousarray(matrix.T, np.float32)
        rtc.rtcSetGeometryTransform(geometry, 0, _FLOAT4X4_COLUMN_MAJOR, columns.ctypes.data)
        rtc.rtcCommitGeometry(geometry)


def packet_buffer(packets: int) -> NDArray[np.float32]:
    """Return room for ray packets, aligned for AVX-512: (packets, 24, 16) float32.

    Rows follow ``RTCRayHit16``: 0–2 origin, 3 tnear, 4–6 direction, 7 time, 8 tfar, 9 mask,
    10 id, 11 flags, 12–14 normal, 15–16 u and v, 17 primID, 18 geomID, 19 instID.
    """
    raw = np.zeros(packets * PACKET_BYTES + 64, np.uint8)
    start = -raw.ctypes.data % 64
    words = raw[start : start + packets * PACKET_BYTES].view(np.float32)
    return words.reshape(packets, PACKET_ROWS, PACKET)
