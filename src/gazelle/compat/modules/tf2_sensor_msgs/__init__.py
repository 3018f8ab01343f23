"""tf2_sensor_msgs, on numpy."""

from gazelle.compat.clouds.moving import do_transform_cloud, register

register()

__all__ = ["do_transform_cloud"]
