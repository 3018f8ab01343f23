"""rostest and rosunit for Python tests: ``rostest.rosrun(PKG, NAME, TestClass)``."""

from __future__ import annotations

import sys
import unittest
from collections.abc import Sequence
from importlib import import_module
from typing import Any

from gazelle.compat.junit import result_file, run_suite
from gazelle.compat.warn_once import warn_once

__all__ = ["rosrun", "run", "unitrun"]


def rosrun(package: str, test_name: str, test: Any, sysargs: Sequence[str] | None = None) -> None:
    """Run a test case as a ``<test>`` node, which ends with it; exit code 1 when it fails.

    Args:
        package: the package it belongs to.
        test_name: its name.
        test: a ``TestCase`` class, or its name ``module.Class``.
        sysargs: the command line, ``sys.argv`` by default.
    """
    from gazelle.compat.rospy.client import signal_shutdown

    try:
        _run(package, test_name, test, sys.argv if sysargs is None else sysargs)
    finally:
        signal_shutdown("test complete")


def unitrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
    coverage_packages: Any = None,
) -> None:
    """Run a test case that needs no graph (`rosunit.unitrun`).

    Args:
        package: the package it belongs to.
        test_name: its name.
        test: a ``TestCase`` class, or its name ``module.Class``.
        sysargs: the command line, ``sys.argv`` by default.
        coverage_packages: told once: coverage is not measured.
    """
    if coverage_packages:
        warn_once("unitrun: coverage is not measured; run the tests with `coverage run`")
    _run(package, test_name, test, sys.argv if sysargs is None else sysargs)


run = rosrun


def _run(package: str, test_name: str, test: Any, words: Sequence[str]) -> None:
    loader = unittest.TestLoader()
    if isinstance(test, str):
        module, _, name = test.rpartition(".")
        test = getattr(import_module(module), name)
    suite = (
        loader.loadTestsFromTestCase(test)
        if isinstance(test, type) and issubclass(test, unittest.TestCase)
        else unittest.TestSuite([test()])
    )
    if not run_suite(suite, f"{package}.{test_name}", result_file(words)):
        sys.exit(1)
