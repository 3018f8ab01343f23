"""A model plug-in: the wind drags at a ball, ``F = ½ ρ c A |v| v`` with v relative to the air."""

import math

from gazelle.simulator.plugins.user import ModelPlugin

AIR_KG_M3 = 1.2
DRAG_OF_A_BALL = 0.47


class WindDrag(ModelPlugin):
    def load(self, model, parameters, node):
        self.link = model.link(parameters["link"])
        radius_m = parameters.number("radius", 0.1)
        self.drag = 0.5 * AIR_KG_M3 * DRAG_OF_A_BALL * math.pi * radius_m**2
        self.wind = parameters.vector("wind")
        node.subscribe("wind", "geometry_msgs/Vector3", self.take_wind)
        self.node = node
        self.output = node.advertise("drag", "geometry_msgs/Vector3")

    def take_wind(self, message):
        self.wind = (message.x, message.y, message.z)

    def on_update(self, time_s):
        speed = self.link.linear_velocity_m_s
        relative = [air - own for air, own in zip(self.wind, speed, strict=True)]
        size = math.hypot(*relative)
        force = tuple(self.drag * size * part for part in relative)
        # Until the next call: a force without an end would add up.
        self.link.apply_wrench(force_n=force, seconds=0.001)
        if self.output.matched:
            x, y, z = force
            self.output.publish(self.node.message("geometry_msgs/Vector3", x=x, y=y, z=z))
