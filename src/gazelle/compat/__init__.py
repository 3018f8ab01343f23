"""Running users' own Python nodes: drop-in modules, message packages, Python 2 on the fly."""
