"""tf2_sensor_msgs, on numpy."""

from gazelle.compat.clouds.tf2_sensor_msgs import do_transform_cloud, register

register()

__all__ = ["do_transform_cloud"]
