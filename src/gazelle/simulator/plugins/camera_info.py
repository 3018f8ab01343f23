"""CameraInfo and images as the camera plug-ins of gazebo_plugins fill them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import CameraSpec
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader

__all__ = ["Calibration", "camera_info_message", "image_message", "read_calibration"]


@dataclass(frozen=True, slots=True)
class Calibration:
    """What a CameraInfo says.

    Attributes:
        frame: ``header.frame_id``.
        focal_px: fx and fy, pixels.
        cx_px, cy_px: principal point as Gazebo's plug-ins publish it, (width + 1) / 2; their
            renderer, and ours, has it at (width - 1) / 2.
        baseline_m: ``hackBaseline``.
        distortion: k1, k2, t1, t2, k3 of the plumb-bob model.
    """

    frame: str
    width_px: int
    height_px: int
    focal_px: float
    cx_px: float
    cy_px: float
    baseline_m: float
    distortion: tuple[float, float, float, float, float]


def read_calibration(
    context: PluginContext, parameters: PluginReader, spec: CameraSpec, frame: str
) -> Calibration:
    """Read the calibration keys (GazeboRosCameraUtils): 0 means computed from the sensor."""
    computed = spec.width_px / (2 * math.tan(spec.horizontal_fov_rad / 2))
    focal = parameters.number("focalLength")
    if focal and abs(focal - computed) > 1e-6 * computed:
        text = f"<focalLength> {focal:g} does not fit the image's width and field of view, which "
        text += f"give {computed:.10g}; camera_info says {focal:g}, the picture is unchanged"
        context.report("parameter.bad-value", text)
    return Calibration(
        frame=frame,
        width_px=spec.width_px,
        height_px=spec.height_px,
        focal_px=focal or computed,
        cx_px=parameters.number("Cx") or (spec.width_px + 1) / 2,
        cy_px=parameters.number("Cy") or (spec.height_px + 1) / 2,
        baseline_m=parameters.number("hackBaseline"),
        distortion=_distortion(parameters, spec),
    )


def camera_info_message(time_ns: int, calibration: Calibration) -> Any:
    """Return a ``sensor_msgs/CameraInfo``."""
    f, cx, cy = calibration.focal_px, calibration.cx_px, calibration.cy_px
    return message_type("sensor_msgs/CameraInfo")(
        header=header(time_ns, calibration.frame),
        height=calibration.height_px,
        width=calibration.width_px,
        distortion_model="plumb_bob",
        d=np.array(calibration.distortion),
        k=np.array([f, 0, cx, 0, f, cy, 0, 0, 1.0]),
        r=np.eye(3).reshape(9),
        p=np.array([f, 0, cx, -f * calibration.baseline_m, 0, f, cy, 0, 0, 0, 1.0, 0]),
    )


def image_message(
    time_ns: int,
    frame: str,
    pixels: NDArray[np.uint8] | NDArray[np.float32] | NDArray[np.uint16],
    encoding: str,
) -> Any:
    """Return a ``sensor_msgs/Image`` that shares the pixels' memory.

    Args:
        time_ns: of the header.
        frame: of the header.
        pixels: (rows, columns) or (rows, columns, channels), of the encoding's numbers.
        encoding: ROS's name.
    """
    height, width = pixels.shape[:2]
    flat = np.ascontiguousarray(pixels).reshape(-1).view(np.uint8)
    return message_type("sensor_msgs/Image")(
        header=header(time_ns, frame),
        height=height,
        width=width,
        encoding=encoding,
        is_bigendian=0,
        step=len(flat) // height,
        data=flat,
    )


def _distortion(
    parameters: PluginReader, spec: CameraSpec
) -> tuple[float, float, float, float, float]:
    if spec.distortion is not None and parameters.flag("autoDistortion"):
        lens = spec.distortion
        return (lens.k1, lens.k2, lens.p1, lens.p2, lens.k3)
    k1, k2, k3, t1, t2 = (
        parameters.number(f"distortion{word}") for word in ("K1", "K2", "K3", "T1", "T2")
    )
    return (k1, k2, t1, t2, k3)
