"""A sensor plug-in in an IMU: says whether the ball is being shaken."""

import math

from gazelle.simulator.plugins.user import SensorPlugin


class GustAlarm(SensorPlugin):
    def load(self, sensor, parameters, node):
        self.sensor, self.node = sensor, node
        self.threshold = parameters.number("threshold", 1.0)
        self.was_shaken = None

    def on_update(self, time_s):
        # Called at the sensor's update rate.
        felt = self.sensor.read().linear_acceleration_m_s2
        # An IMU at rest feels the world's gravity upwards.
        is_shaken = math.hypot(felt[0], felt[1]) > self.threshold
        if is_shaken != self.was_shaken:
            self.was_shaken = is_shaken
            self.node.publish("alarm", self.node.message("std_msgs/Bool", data=is_shaken))

    def on_reset(self):
        self.was_shaken = None
