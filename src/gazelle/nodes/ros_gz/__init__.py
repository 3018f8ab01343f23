"""``ros_gz_bridge``, ``ros_gz_sim`` and ``ros_gz_image``, which used to be called ``ros_ign_…``."""
