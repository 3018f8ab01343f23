"""Verbs of bags: packing chunks, which C++ has no libraries for. Bytes travel as base64."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []


@verb("bag/compress")
def pack(host: HostContext, request: dict[str, Any]) -> str:
    """Return a chunk's data packed by ``compression`` (none, bz2, lz4)."""
    from gazelle.bag.ros1.chunks import Compression, compress

    del host
    data = compress(base64.b64decode(request["data"]), Compression(request["compression"]))
    return base64.b64encode(data).decode()


@verb("bag/decompress")
def unpack(host: HostContext, request: dict[str, Any]) -> str:
    """Return a chunk's data, which is ``size`` bytes long."""
    from gazelle.bag.ros1.chunks import decompress

    del host
    packed = base64.b64decode(request["data"])
    return base64.b64encode(decompress(packed, request["compression"], request["size"])).decode()
