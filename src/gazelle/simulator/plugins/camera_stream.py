"""One camera's pictures: rendered when due and wanted, turned into messages, published."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import CameraSpec
from gazelle.interfaces.stamps import header
from gazelle.simulator.node_interfaces import PublisherPort
from gazelle.simulator.plugins.camera_info import Calibration, camera_info_message
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.dynamic_reconfigure import DynamicParameter, DynamicParameters
from gazelle.simulator.scheduler import ORDER_SENSOR, period_in_steps, throttled_period_in_steps

if TYPE_CHECKING:
    from gazelle.sensors import CameraRecord
    from gazelle.simulator.sensor_set import View

__all__ = ["CameraStream", "camera_place", "check_frame"]

Build = Callable[[int, "CameraRecord"], Any]


@dataclass(frozen=True, slots=True)
class _Output:
    publisher: PublisherPort
    build: Build
    rgb: bool
    depth: bool


class CameraStream:
    """Publishes what one camera sees on any number of topics."""

    def __init__(
        self,
        context: PluginContext,
        place: SensorPlace,
        calibration: Calibration,
        namespace: str,
        *,
        largest_rate_hz: float = 0.0,
    ) -> None:
        """Start the stream with its services; `add` and `add_info` give it topics.

        Args:
            context: the plug-in's.
            place: a camera.
            calibration: what camera_info says.
            namespace: of the camera's services, such as ``/depth_camera``.
            largest_rate_hz: lowers the sensor's rate; 0 leaves it.
        """
        self._host = context.host
        self._place = place
        self.calibration = calibration
        self._largest_rate_hz = largest_rate_hz
        self._outputs: list[_Output] = []
        self._infos: list[PublisherPort] = []
        self._set_info: Any = None
        self._dropped = False
        self._triggers: int | None = None
        self._shot_ns = -1
        self._resources = context.resources
        self._task = context.resources.task(
            place.name,
            place.period_in_steps(self._host.engine.step_ns, largest_rate_hz),
            self._capture,
            order=ORDER_SENSOR,
            wanted=self._wanted,
        )
        name = join_names(namespace, "set_camera_info")
        context.resources.service(name, "sensor_msgs/SetCameraInfo", self._take_info)
        self._offer_rate(namespace)

    def add(
        self, topic: str, type_name: str, build: Build, *, rgb: bool = False, depth: bool = False
    ) -> None:
        """Publish `build(time_ns, record)` on a topic; `rgb` and `depth` say what it reads."""
        publisher = self._resources.publisher(topic, type_name, reliable=False)
        self._outputs.append(_Output(publisher, build, rgb, depth))

    def add_info(self, topic: str) -> None:
        """Publish camera_info on a topic, with the pictures or alone."""
        self._infos.append(self._resources.publisher(topic, "sensor_msgs/CameraInfo"))

    def wait_for_triggers(self, topic: str) -> None:
        """Take one picture for each ``std_msgs/Empty`` on a topic instead of pictures at a rate."""
        self._triggers = 0
        self._host.scheduler.change_period(self._task, Fraction(1))

        def pull(message: Any) -> None:
            self._triggers = (self._triggers or 0) + 1
            # The task sleeps; the picture is that of the next step.
            self._host.scheduler.look()

        self._resources.subscription(topic, "std_msgs/Empty", pull)

    def _wanted(self) -> bool:
        if self._triggers is not None:
            return self._triggers > 0
        return any(item.publisher.matched for item in self._outputs) or any(
            item.matched for item in self._infos
        )

    def _capture(self) -> None:
        time_ns = self._host.engine.time_ns
        if self._triggers is not None:
            # A task that was woken catches up; one step has one picture.
            if time_ns == self._shot_ns:
                return
            self._triggers, self._shot_ns = self._triggers - 1, time_ns
        outputs = [item for item in self._outputs if item.publisher.matched]
        if not outputs:
            self._publish_infos(time_ns)
            return
        view = self._host.sensors.view()
        if self._host.lockstep:
            self._host.frames.do(lambda: self._produce(time_ns, view, outputs))
        else:
            started = self._host.frames.submit(
                self._place.name, lambda: self._produce(time_ns, view, outputs)
            )
            if not started:
                self._report_drop()

    def _produce(self, time_ns: int, view: View, outputs: list[_Output]) -> None:
        record = self._host.sensors.render(
            self._place,
            view,
            want_rgb=any(item.rgb for item in outputs),
            want_depth=any(item.depth for item in outputs),
        )
        for item in outputs:
            item.publisher.publish(item.build(time_ns, record))
        self._publish_infos(time_ns)

    def _report_drop(self) -> None:
        if self._dropped:
            return
        self._dropped = True
        sensor = self._place.sensor
        text = f"camera '{self._place.name}' is late for its {sensor.update_rate_hz:g} Hz: frames "
        text += "are dropped"
        self._host.diagnostics.report("simulator.frames-dropped", text, sensor.span)
        self._host.node.log("WARN", text)

    def _publish_infos(self, time_ns: int) -> None:
        for publisher in self._infos:
            if publisher.matched:
                publisher.publish(self._info(time_ns))

    def _info(self, time_ns: int) -> Any:
        if self._set_info is None:
            return camera_info_message(time_ns, self.calibration)
        # A message that was published belongs to whoever got it.
        info = copy(self._set_info)
        info.header = header(time_ns, self.calibration.frame)
        return info

    def _take_info(self, request: Any, response: Any) -> None:
        self._set_info = request.camera_info
        response.success = True
        response.status_message = ""

    def _offer_rate(self, namespace: str) -> None:
        rate = DynamicParameter(
            "imager_rate", "double", 2.0, "Frame rate of the camera, Hz.", 1.0, 50.0, level=3
        )

        def change(values: dict[str, bool | int | float | str]) -> None:
            if self._triggers is not None:
                return
            rate_hz, step_ns = float(values["imager_rate"]), self._host.engine.step_ns
            period = throttled_period_in_steps(
                period_in_steps(rate_hz, step_ns), self._largest_rate_hz, step_ns
            )
            self._host.scheduler.change_period(self._task, period)

        DynamicParameters(self._resources, self._host, namespace, (rate,), changed=change)


def camera_place(context: PluginContext) -> SensorPlace | None:
    """Return the camera the plug-in stands in; reports a wrong place and returns None."""
    place = context.place
    if place is not None and isinstance(place.sensor.spec, CameraSpec):
        return place
    found = f"a sensor of type '{place.sensor.type}'" if place else "no sensor"
    text = f"plug-in '{context.plugin.name}' ({context.plugin.filename}) needs a camera around it "
    context.report("plugin.wrong-place", text + f"and stands in {found}; it is left out")
    return None


def check_frame(context: PluginContext, place: SensorPlace, frame: str) -> None:
    """Report a frame that is a link without optical axes: clouds look turned in viewers."""
    model = context.model
    link = model.link(frame)
    own = model.link(place.link_name.split("::", 1)[1])
    if link is None or own is None:
        return
    T_frame_camera = link.T_model_link.inverse() @ own.T_model_link @ place.sensor.T_link_sensor
    # The camera's x axis must be the frame's z axis.
    forward = T_frame_camera.rotate((1.0, 0.0, 0.0))
    if np.allclose(forward, (0.0, 0.0, 1.0), atol=1e-3):
        return
    text = f"frame '{frame}' of camera '{place.sensor.name}' is a link with x forward, its images "
    text += "and clouds are in optical axes (z forward): they look turned in a 3D view"
    context.report("plugin.camera-frame", text)
