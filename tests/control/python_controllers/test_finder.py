"""A controller's class is found by its type's name."""

from __future__ import annotations

import pytest
from tests.installed_packages import installed

from gazelle.control.errors import ControllerError

SIMPLE = """
class MyController:
    def init(self, robot, node):
        node.log_info("{word}")

    def update(self, time, period):
        pass
"""


@pytest.mark.parametrize("type_name", ["MyController", "mine_pkg/MyController",
                                       "mine_pkg::MyController"])  # fmt: skip
def test_a_class_is_found_by_bare_name_and_with_its_package(bench, type_name):
    bench.package("mine_pkg", src__mine_pkg__controllers=SIMPLE.format(word="found"))
    bench.run(type_name)
    assert ("info", "found") in bench.ports.lines


def test_the_named_package_comes_before_all_others(bench):
    bench.package("a_pkg", scripts__c=SIMPLE.format(word="a"))
    bench.package("b_pkg", scripts__c=SIMPLE.format(word="b"))
    bench.run("b_pkg/MyController")
    assert bench.ports.lines == [("info", "b")]


def test_two_classes_of_one_name_are_told_apart_by_the_package(bench):
    bench.package("a_pkg", scripts__c=SIMPLE.format(word="a"))
    bench.package("b_pkg", scripts__c=SIMPLE.format(word="b"))
    with pytest.raises(
        ControllerError,
        match=r"several files have a class 'MyController': .*a_pkg/scripts/c.py:2, "
        r".*b_pkg/scripts/c.py:2; write the type as package/",
    ):
        bench.run("MyController")


def test_other_files_are_not_imported(bench):
    bench.package("a_pkg", scripts__c=SIMPLE.format(word="a"), scripts__d="raise SystemExit(3)")
    bench.run("MyController")
    assert bench.ports.lines == [("info", "a")]


def test_a_file_imports_its_neighbours(bench):
    bench.package(
        "a_pkg",
        scripts__gains_of_mine="GAIN = 3.5",
        scripts__c="""
        from gains_of_mine import GAIN

        class MyController:
            def init(self, robot, node):
                node.log_info(str(GAIN))

            def update(self, time, period):
                pass
        """,
    )
    bench.run("MyController")
    assert bench.ports.lines == [("info", "3.5")]


def test_a_changed_file_counts_when_the_controller_is_loaded_again(bench):
    root = bench.package("a_pkg", scripts__c=SIMPLE.format(word="old"))
    manager = bench.run("MyController")
    manager.switch(stop=["mine"])
    manager.unload("mine")
    path = root / "scripts" / "c.py"
    path.write_text(SIMPLE.format(word="new, and longer"))
    manager.load("mine")
    assert [text for _, text in bench.ports.lines] == ["old", "new, and longer"]


def test_python_2_is_refused_with_its_line(bench):
    bench.package(
        "a_pkg", scripts__c="class MyController:\n    def update(self):\n        print 1\n"
    )
    with pytest.raises(ControllerError, match=r"c.py:3: the file may have .* not Python 3"):
        bench.run("MyController")


def test_an_error_while_importing_has_its_line(bench):
    bench.package("a_pkg", scripts__c=f"import nothing_like_this\n{SIMPLE}")
    with pytest.raises(ControllerError, match=r"scripts/c.py:1 in <module>\(\): ModuleNotFound"):
        bench.run("MyController")


def test_a_type_that_is_nowhere_says_how_to_write_one(bench):
    bench.package("a_pkg", scripts__c=SIMPLE)
    with pytest.raises(
        ControllerError,
        match=r"Could not load class 'a_pkg/Other'.*no Python file of the workspace has a class "
        r"'Other' .*one of your own is a Python class with init, starting, update, stopping",
    ):
        bench.run("a_pkg/Other")


def test_a_class_that_only_shares_the_name_is_no_controller(bench):
    bench.package("a_pkg", scripts__c="class MyController:\n    colour = 'red'\n")
    with pytest.raises(ControllerError, match="has a class 'MyController'"):
        bench.run("MyController")


def test_a_controller_of_an_installed_package_is_found_by_its_type(bench, tmp_path):
    points = {"gazelle.controllers": {"far_pkg/MyController": "far_parts:MyController"}}
    with installed(tmp_path / "site", "far_parts", SIMPLE.format(word="far"), points):
        bench.run("far_pkg::MyController")
        assert bench.ports.lines == [("info", "far")]


def test_a_controller_with_a_table_may_be_installed(bench, tmp_path):
    source = """
        from gazelle.control.controllers.joint_state_controller import JointStateController

        class Doubled(JointStateController):
            pass
    """
    points = {"gazelle.controllers": {"far_pkg/Doubled": "far_parts:Doubled"}}
    with installed(tmp_path / "site", "far_parts", source, points):
        bench.run("far_pkg/Doubled", publish_rate=50, speed=3)
        (told,) = bench.diagnostics
        assert "parameter '/mine/speed' is not one of this controller" in told.message


def test_an_installed_controller_that_cannot_be_had_is_told(bench, tmp_path):
    points = {"gazelle.controllers": {"a/A": "far_parts:A", "a/B": "far_parts:B"}}
    with installed(tmp_path / "site", "far_parts", "B = 3\n", points):
        text = r"entry point 'a/A = far_parts:A' of far_parts 1.2 \(gazelle.controllers\) cannot "
        with pytest.raises(ControllerError, match=text + "be loaded: AttributeError: "):
            bench.run("a/A")
        with pytest.raises(ControllerError, match=r"\(gazelle.controllers\) is a int, not a class"):
            bench.run("a/B")
