"""qt_gui, if it is installed; else the error that says how windows are written for Gazelle."""

from gazelle.compat.rqt import installed_or_refused

installed_or_refused(__name__)
