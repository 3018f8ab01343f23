"""rosunit."""

from gazelle.compat.unit_tests import unitrun

__all__ = ["unitrun"]
