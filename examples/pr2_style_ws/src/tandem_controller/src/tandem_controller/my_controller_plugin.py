"""Turns both wheels to an angle: a controller of one's own, named in config/controller.yaml.

    rostopic pub -1 /tandem_controller/command std_msgs/Float64 3.0

makes the robot roll 3 rad of its wheels forward, 0.36 m.
"""

from gazelle.control import Pid

# A target that jumped would kick the wheels: the gain d acts on its rate.
MAX_SPEED_RAD_S = 2.0


class MyControllerPlugin:
    """Holds each wheel at the commanded angle with the gains of ``pid_steer``."""

    def init(self, robot, node):
        """Take the wheels and the gains; False when something is missing."""
        self.wheels = []
        for key in ("wheel1", "wheel2"):
            name = node.getParam(key)
            if name is None:
                node.log_error(f"No joint given in namespace: '{node.getNamespace()}'")
                return False
            wheel = robot.getJointState(name)
            if wheel is None:
                node.log_error(f"MyController could not find joint named '{name}'")
                return False
            self.wheels.append(wheel)
        self.pids = [Pid(), Pid()]
        if not self.pids[0].init(node, "pid_steer"):
            return False
        self.target = self.angle = 0.0
        node.subscribe("command", "std_msgs/Float64", self.on_command)
        return True

    def starting(self, time):
        """Stay where the wheels are."""
        self.angle = sum(wheel.position_ for wheel in self.wheels) / len(self.wheels)
        self.target = self.angle
        for pid in self.pids:
            pid.reset()

    def update(self, time, period):
        """Push each wheel towards the angle; runs at every tick of the control loop."""
        step = MAX_SPEED_RAD_S * period.to_sec()
        self.angle += max(-step, min(self.target - self.angle, step))
        # The gains of the first PID can be changed live; the second one has the same.
        self.pids[1].gains = self.pids[0].gains
        for wheel, pid in zip(self.wheels, self.pids, strict=True):
            wheel.commanded_effort_ = pid.updatePid(wheel.position_ - self.angle, period)

    def stopping(self, time):
        """Let the wheels roll."""
        for wheel in self.wheels:
            wheel.commanded_effort_ = 0.0

    def on_command(self, message):
        """Take an angle, rad."""
        self.target = message.data
