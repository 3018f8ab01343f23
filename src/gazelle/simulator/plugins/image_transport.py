"""The topics that image_transport puts beside a picture's: compressed, compressedDepth, theora."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.simulator.plugins.camera_stream import CameraStream
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.dynamic_reconfigure import DynamicParameter, DynamicParameters
from gazelle.simulator.plugins.image_encoding import compressed_depth_message, compressed_message

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gazelle.sensors import CameraRecord

__all__ = ["add_transports"]

_COMPRESSED = (
    DynamicParameter("format", "str", "jpeg", "Compression: jpeg or png."),
    DynamicParameter("jpeg_quality", "int", 80, "JPEG quality in per cent.", 1, 100),
    DynamicParameter("png_level", "int", 9, "PNG compression level.", 1, 9),
)
_COMPRESSED_DEPTH = (
    DynamicParameter("depth_max", "double", 10.0, "Largest depth, m.", 1.0, 100.0),
    DynamicParameter("depth_quantization", "double", 100.0, "Quantisation.", 1.0, 150.0),
    DynamicParameter("png_level", "int", 9, "PNG compression level.", 1, 9),
)
_THEORA = (
    DynamicParameter("optimize_for", "int", 1, "0 bitrate, 1 quality.", 0, 1),
    DynamicParameter("target_bitrate", "int", 800000, "Bits per second.", 0, 99200000),
    DynamicParameter("quality", "int", 31, "Quality.", 0, 63),
    DynamicParameter("keyframe_frequency", "int", 64, "Frames between key frames.", 1, 64),
)
Build = Callable[[int, "CameraRecord"], object]
DepthOf = Callable[["CameraRecord"], "NDArray[np.float32]"]


def add_transports(
    context: PluginContext, stream: CameraStream, topic: str, *, depth_of: DepthOf | None = None
) -> None:
    """Offer the transports of one picture.

    Args:
        context: the plug-in's.
        stream: the camera.
        topic: of the raw picture, remappings applied: transports go by the final name.
        depth_of: None for a colour picture, else what depth to encode.
    """
    frame, compressed_type = stream.calibration.frame, "sensor_msgs/CompressedImage"
    jpeg = _parameters(context, topic, "compressed", _COMPRESSED)
    deep = _parameters(context, topic, "compressedDepth", _COMPRESSED_DEPTH)
    _parameters(context, topic, "theora", _THEORA)
    if depth_of is None:
        build = _compressed(frame, jpeg)
        stream.add(join_names(topic, "compressed"), compressed_type, build, rgb=True)
        context.resources.publisher(join_names(topic, "compressedDepth"), compressed_type)
    else:
        build = _compressed_depth(frame, deep, depth_of)
        context.resources.publisher(join_names(topic, "compressed"), compressed_type)
        stream.add(join_names(topic, "compressedDepth"), compressed_type, build, depth=True)
    _learn_theora()
    context.resources.publisher(join_names(topic, "theora"), "theora_image_transport/Packet")
    idle = "compressedDepth and theora send" if depth_of is None else "compressed and theora send"
    text = f"'{topic}' is listed with its image transports; {idle} nothing"
    context.report("plugin.no-encoder", text)


def _parameters(
    context: PluginContext, topic: str, kind: str, rows: tuple[DynamicParameter, ...]
) -> DynamicParameters:
    host, namespace = context.host, join_names(topic, kind)
    # Values are looked up at each picture: nothing to do when they change.
    return DynamicParameters(context.resources, host, namespace, rows, changed=lambda values: None)


def _compressed(frame: str, settings: DynamicParameters) -> Build:
    def build(time_ns: int, record: CameraRecord) -> object:
        assert record.rgb is not None
        return compressed_message(
            time_ns,
            frame,
            record.rgb,
            kind=str(settings.values["format"]),
            quality=int(settings.values["jpeg_quality"]),
            png_level=int(settings.values["png_level"]),
        )

    return build


def _compressed_depth(frame: str, settings: DynamicParameters, depth_of: DepthOf) -> Build:
    def build(time_ns: int, record: CameraRecord) -> object:
        return compressed_depth_message(
            time_ns,
            frame,
            depth_of(record),
            depth_max_m=float(settings.values["depth_max"]),
            quantization=float(settings.values["depth_quantization"]),
            png_level=int(settings.values["png_level"]),
        )

    return build


def _learn_theora() -> None:
    """The one message type that only this module names."""
    from gazelle.interfaces import RosVersion, add_package

    folder = Path(__file__).with_name("definitions") / "theora_image_transport"
    add_package("theora_image_transport", folder, RosVersion.ROS1)
