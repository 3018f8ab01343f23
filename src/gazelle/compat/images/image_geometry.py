"""Pinhole cameras (image_geometry): pixels and rays by a ``sensor_msgs/CameraInfo``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["PinholeCameraModel", "StereoCameraModel"]

Matrix = NDArray[np.float64]
Pixel = tuple[float, float]
_NO_PIXEL = (float("nan"), float("nan"))
_MATRICES = {"d", "k", "p", "r"}  # capitals in ROS 1
_STEPS = 20  # of undoing the distortion; OpenCV takes five


class PinholeCameraModel:
    """A calibrated camera.

    Attributes:
        K, R, P: intrinsic, rectification and projection matrices.
        D: distortion coefficients (plumb_bob or rational_polynomial), one column.
        width, height: of the picture, pixels.
        tf_frame: frame of the camera.
        stamp: time of the calibration message.
    """

    def __init__(self) -> None:
        self.K = self.R = self.full_K = self.P = self.full_P = _matrix([], -1)
        self.D = _matrix([], -1)
        self.width = self.height = 0
        self.binning_x = self.binning_y = 0
        self.tf_frame = ""
        self.stamp: Any = None

    def from_camera_info(self, msg: Any) -> None:
        """Take over a ``sensor_msgs/CameraInfo``; its region of interest and binning count."""
        fields = {
            name.lower(): getattr(msg, name) for name in dir(msg) if name.lower() in _MATRICES
        }
        self.full_K = _matrix(fields["k"], 3)
        self.full_P = _matrix(fields["p"], 3)
        self.R = _matrix(fields["r"], 3)
        self.D = _matrix(fields["d"], -1)
        self.width, self.height = int(msg.width), int(msg.height)
        self.binning_x, self.binning_y = max(1, msg.binning_x), max(1, msg.binning_y)
        self.tf_frame = msg.header.frame_id
        self.stamp = msg.header.stamp
        self.K, self.P = self.full_K.copy(), self.full_P.copy()
        for matrix in (self.K, self.P):
            matrix[0, 2] -= msg.roi.x_offset
            matrix[1, 2] -= msg.roi.y_offset
            matrix[0] /= self.binning_x
            matrix[1] /= self.binning_y

    def fx(self) -> float:
        """Return the focal length along x, pixels."""
        return float(self.P[0, 0])

    def fy(self) -> float:
        """Return the focal length along y, pixels."""
        return float(self.P[1, 1])

    def cx(self) -> float:
        """Return the principal point's x, pixels."""
        return float(self.P[0, 2])

    def cy(self) -> float:
        """Return the principal point's y, pixels."""
        return float(self.P[1, 2])

    def Tx(self) -> float:
        """Return the projection's offset along x."""
        return float(self.P[0, 3])

    def Ty(self) -> float:
        """Return the projection's offset along y."""
        return float(self.P[1, 3])

    def fovX(self) -> float:
        """Return the horizontal field of view, radians."""
        return 2 * math.atan(self.width / (2 * float(self.K[0, 0]) * self.binning_x))

    def fovY(self) -> float:
        """Return the vertical field of view, radians."""
        return 2 * math.atan(self.height / (2 * float(self.K[1, 1]) * self.binning_y))

    def project_3d_to_pixel(self, point: Any) -> Pixel:
        """Return the rectified pixel of a point in the camera's optical frame, metres.

        It is not a number for points in the camera's plane.
        """
        column = np.array([*map(float, point), 1.0])
        x, y, w = (float(value) for value in np.asarray(self.P) @ column)
        return (x / w, y / w) if w else _NO_PIXEL

    def project_pixel_to_3d_ray(self, uv: Any) -> tuple[float, float, float]:
        """Return the unit vector towards a rectified pixel."""
        x = (float(uv[0]) - self.cx()) / self.fx()
        y = (float(uv[1]) - self.cy()) / self.fy()
        length = math.sqrt(x * x + y * y + 1.0)
        return x / length, y / length, 1.0 / length

    def rectify_point(self, uv_raw: Any) -> Pixel:
        """Return where a pixel of the raw picture is in the rectified one."""
        k = np.asarray(self.K)
        wanted = np.array(
            [(float(uv_raw[0]) - k[0, 2]) / k[0, 0], (float(uv_raw[1]) - k[1, 2]) / k[1, 1]]
        )
        found = wanted.copy()
        for _ in range(_STEPS):
            found += wanted - _distorted(found, np.asarray(self.D).ravel())
        ray = np.asarray(self.R) @ np.array([*found, 1.0])
        x, y = ray[:2] / ray[2]
        return float(x * self.fx() + self.cx()), float(y * self.fy() + self.cy())

    def unrectify_point(self, uv_rect: Any) -> Pixel:
        """Return where a pixel of the rectified picture is in the raw one."""
        ray = np.asarray(self.R).T @ np.array(self.project_pixel_to_3d_ray(uv_rect))
        x, y = _distorted(ray[:2] / ray[2], np.asarray(self.D).ravel())
        k = np.asarray(self.K)
        return float(x * k[0, 0] + k[0, 2]), float(y * k[1, 1] + k[1, 2])

    def get_delta_u(self, delta_x: float, z: float) -> float:
        """Return the pixels that a length along x takes at a depth; infinite at 0."""
        return self.fx() * delta_x / z if z else float("inf")

    def get_delta_v(self, delta_y: float, z: float) -> float:
        """Return the pixels that a length along y takes at a depth; infinite at 0."""
        return self.fy() * delta_y / z if z else float("inf")

    def get_delta_x(self, delta_u: float, z: float) -> float:
        """Return the length along x of some pixels at a depth."""
        return z * delta_u / self.fx()

    def get_delta_y(self, delta_v: float, z: float) -> float:
        """Return the length along y of some pixels at a depth."""
        return z * delta_v / self.fy()

    def fullResolution(self) -> tuple[int, int]:
        """Return width and height."""
        return self.width, self.height

    def intrinsicMatrix(self) -> Any:
        """Return K."""
        return self.K

    def fullIntrinsicMatrix(self) -> Any:
        """Return K of the whole picture."""
        return self.full_K

    def fullProjectionMatrix(self) -> Any:
        """Return P of the whole picture."""
        return self.full_P

    def distortionCoeffs(self) -> Any:
        """Return D."""
        return self.D

    def rotationMatrix(self) -> Any:
        """Return R."""
        return self.R

    def projectionMatrix(self) -> Any:
        """Return P."""
        return self.P

    def tfFrame(self) -> str:
        """Return the camera's frame."""
        return self.tf_frame

    fromCameraInfo = from_camera_info  # noqa: N815
    project3dToPixel = project_3d_to_pixel  # noqa: N815
    projectPixelTo3dRay = project_pixel_to_3d_ray  # noqa: N815
    rectifyPoint = rectify_point  # noqa: N815
    unrectifyPoint = unrectify_point  # noqa: N815

    def getDeltaU(self, deltaX: float, Z: float) -> float:
        """Return `get_delta_u` (the old name)."""
        return self.get_delta_u(deltaX, Z)

    def getDeltaV(self, deltaY: float, Z: float) -> float:
        """Return `get_delta_v` (the old name)."""
        return self.get_delta_v(deltaY, Z)

    def getDeltaX(self, deltaU: float, Z: float) -> float:
        """Return `get_delta_x` (the old name)."""
        return self.get_delta_x(deltaU, Z)

    def getDeltaY(self, deltaV: float, Z: float) -> float:
        """Return `get_delta_y` (the old name)."""
        return self.get_delta_y(deltaV, Z)


class StereoCameraModel:
    """Two cameras side by side.

    Attributes:
        left, right: the cameras.
    """

    def __init__(self) -> None:
        self.left = PinholeCameraModel()
        self.right = PinholeCameraModel()

    def from_camera_info(self, left_msg: Any, right_msg: Any) -> None:
        """Take over two ``sensor_msgs/CameraInfo``."""
        self.left.from_camera_info(left_msg)
        self.right.from_camera_info(right_msg)

    def project_3d_to_pixel(self, point: Any) -> tuple[Pixel, Pixel]:
        """Return the pixels of a point in the left camera's optical frame."""
        return self.left.project_3d_to_pixel(point), self.right.project_3d_to_pixel(point)

    def project_pixel_to_3d(self, left_uv: Any, disparity: float) -> tuple[float, float, float]:
        """Return the point of a pixel with a disparity, metres."""
        depth = self.get_z(disparity)
        x = self.left.get_delta_x(float(left_uv[0]) - self.left.cx(), depth)
        return x, self.left.get_delta_y(float(left_uv[1]) - self.left.cy(), depth), depth

    def get_z(self, disparity: float) -> float:
        """Return the depth of a disparity, infinite at 0."""
        if disparity == 0:
            return float("inf")
        # The cameras' principal points may differ along x.
        shift = self.left.cx() - self.right.cx()
        return -self.right.Tx() / (disparity - shift)

    def get_disparity(self, depth: float) -> float:
        """Return the disparity of a depth, infinite at 0."""
        if depth == 0:
            return float("inf")
        return -self.right.Tx() / depth + self.left.cx() - self.right.cx()

    def tfFrame(self) -> str:
        """Return the left camera's frame."""
        return self.left.tf_frame

    fromCameraInfo = from_camera_info  # noqa: N815
    project3dToPixel = project_3d_to_pixel  # noqa: N815
    projectPixelTo3d = project_pixel_to_3d  # noqa: N815
    getZ = get_z  # noqa: N815

    def getDisparity(self, Z: float) -> float:
        """Return `get_disparity` (the old name)."""
        return self.get_disparity(Z)


def _matrix(values: Any, n_rows: int) -> Any:
    """Return a matrix class's view, which multiplies as programs of ROS 1 expect."""
    rows = np.array(values, float)
    return rows.reshape(n_rows, -1 if n_rows > 0 else 1).view(np.matrix)


def _distorted(point: Matrix, coefficients: Matrix) -> Matrix:
    """Return a normalised point after the lens: plumb_bob, or rational with eight coefficients."""
    k1, k2, p1, p2, k3, k4, k5, k6 = np.concatenate([coefficients, np.zeros(8)])[:8]
    x, y = point
    r2 = x * x + y * y
    radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    return np.array(
        [
            x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y,
        ]
    )
