"""diagnostic_updater, by Gazelle."""

from gazelle.compat.diagnostic_updater import *  # noqa: F403
from gazelle.compat.diagnostic_updater.tasks import DiagnosticStatus as _Status

OK, WARN, ERROR = _Status.OK, _Status.WARN, _Status.ERROR
