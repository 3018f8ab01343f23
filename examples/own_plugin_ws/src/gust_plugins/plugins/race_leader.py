"""A world plug-in: names the model that is farthest along x, ten times a second."""

from gazelle.simulator.plugins.user import WorldPlugin


class RaceLeader(WorldPlugin):
    update_rate_hz = 10.0

    def load(self, world, parameters, node):
        self.world, self.node = world, node
        node.advertise("/leader", "std_msgs/String")

    def on_update(self, time_s):
        moving = [model.name for model in self.world.description.models if not model.static]
        leader = max(moving, key=lambda name: self.world.model(name).pose.position_m[0])
        self.node.publish("/leader", self.node.message("std_msgs/String", data=leader))
