"""The control law, without topics: lean, speed and place in, torques of the wheels out.

The gains are those of a linear quadratic regulator for the robot's masses.
"""

import math

# N m of both wheels together, for each m, m/s, rad and rad/s.
K_PLACE, K_SPEED, K_LEAN, K_LEAN_RATE = 4.5, 7.4, 30.0, 8.3
# N m of each wheel, for each rad and rad/s.
K_HEADING, K_TURN = 3.0, 0.6
# It goes back to where it was pushed from, in no hurry, and gives up what is farther.
MOST_FELT_M, FARTHEST_M = 0.3, 2.0
MOST_FELT_RAD = 0.4


class Balancer:
    """Keeps a robot of two wheels up.

    Attributes:
        speed: where to, m/s.
        turn_rate: rad/s.
    """

    def __init__(self, wheel_radius, wheel_separation, torque_limit):
        self.wheel_radius = wheel_radius
        self.wheel_separation = wheel_separation
        self.torque_limit = torque_limit
        self.speed = self.turn_rate = 0.0
        self.forget()

    def forget(self):
        """Let where it is now be where it is to be."""
        self.goal = self.goal_heading = None

    def torques(self, lean, lean_rate, wheel_angles, wheel_rates, period):
        """Return the torques of the left and the right wheel.

        The joints turn against the body, which leans: the wheels' own angles are theirs and its.
        """
        left, right = (angle + lean for angle in wheel_angles)
        left_rate, right_rate = (rate + lean_rate for rate in wheel_rates)
        place = self.wheel_radius * (left + right) / 2
        speed = self.wheel_radius * (left_rate + right_rate) / 2
        heading = self.wheel_radius * (right - left) / self.wheel_separation
        turn_rate = self.wheel_radius * (right_rate - left_rate) / self.wheel_separation
        if self.goal is None:
            self.goal, self.goal_heading = place, heading
        goal, goal_heading = self.goal + self.speed * period, self.goal_heading
        goal_heading += self.turn_rate * period
        self.goal = between(place - FARTHEST_M, goal, place + FARTHEST_M)
        self.goal_heading = between(heading - MOST_FELT_RAD, goal_heading, heading + MOST_FELT_RAD)
        away = between(-MOST_FELT_M, place - self.goal, MOST_FELT_M)
        drive = K_PLACE * away + K_SPEED * (speed - self.speed)
        drive += K_LEAN * lean + K_LEAN_RATE * lean_rate
        turn = K_HEADING * (self.goal_heading - heading) + K_TURN * (self.turn_rate - turn_rate)
        limit = self.torque_limit
        return tuple(between(-limit, drive / 2 + side * turn, limit) for side in (-1, 1))


def between(lowest, value, highest):
    return max(lowest, min(value, highest))


def lean_of(orientation):
    """Return how far something leans forward, rad."""
    x, y, z, w = orientation.x, orientation.y, orientation.z, orientation.w
    return math.asin(between(-1.0, 2 * (w * y - z * x), 1.0))
