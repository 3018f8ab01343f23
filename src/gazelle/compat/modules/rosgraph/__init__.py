"""rosgraph: the calls that node programs make to a master."""

from gazelle.compat.rosgraph import Master, MasterException, get_master_uri, is_master_online

__all__ = ["Master", "MasterException", "get_master_uri", "is_master_online"]
