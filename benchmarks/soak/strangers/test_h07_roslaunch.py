"""roslaunch's own test files: parameters, arguments, and what must not load (ROS 1 Noetic)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import yaml
from stage import Finished, Stage

XML = "ws/src/roslaunch/test/xml"
# These two load in roslaunch too: the one is there to be included, and its own test of the other
# is switched off, for pass_all_args may hand on more than the file takes.
LOAD = {"test-arg-invalid-included.xml", "test-arg-invalid-include2.xml"}
# As test_roslaunch_dump_params.py has it.
DICT1 = {"dict1/head": 1, "dict1/shoulders": 2, "dict1/knees": 3, "dict1/toes": 4}
DUMPED = {
    **{f"{ns}/{key}": value for ns in ("", "/rosparam", "/node_rosparam")
       for key, value in {"string1": "bar", **DICT1}.items()},
    "/node_rosparam/tilde1": "foo", "/node_rosparam/local_param": "baz",
    "/node_rosparam2/tilde1": "foo",
    "/inline_str": "value1", "/inline_list": [1, 2, 3, 4],
    "/inline_dict/key1": "value1", "/inline_dict/key2": "value2",
    "/inline_dict2/key3": "value3", "/inline_dict2/key4": "value4",
    "/override/key1": "override1", "/override/key2": "value2",
    "/noparam1": "value1", "/noparam2": "value2",
}  # fmt: skip


def dumped(stage: Stage, words: str) -> dict[str, object]:
    """The parameters of a launch file."""
    ran = stage.run(f"roslaunch --dump-params {words}")
    assert ran.code == 0, ran.output
    values: dict[str, object] = yaml.safe_load(ran.stdout)
    return values


def refused(stage: Stage, name: str) -> Finished:
    """How a file of the folder does not load."""
    ran = stage.run(f"roslaunch {XML}/{name}", timeout_s=30.0)
    assert ran.code == 1, f"{name}: {ran.output}"
    return ran


def test_parameters_are_dumped_as_roslaunch_does(stage: Stage) -> None:
    assert dumped(stage, "roslaunch noop.launch") == {"/noop": "noop"}
    assert len(DUMPED) == 28
    assert dumped(stage, "roslaunch test-dump-rosparam.launch") == DUMPED


def test_types_and_contents_of_parameters_are_kept(stage: Stage) -> None:
    values = dumped(stage, f"{XML}/test-params-valid.xml")
    text = (stage.folder / "ws/src/roslaunch/resources/example.launch").read_text()
    expected = {
        "/somestring1": "bar2", "/somestring2": "10", "/someinteger1": 1, "/someinteger2": 2,
        "/somefloat1": 3.14159, "/somefloat2": 5.0, "/someyaml1": [0, 1, 2],
        "/someyaml2/string2": "10", "/someyaml2/float1": 3.14, "/someyaml2/list2": ["a", "b", "c"],
        "/wg/wgchildparam": "a child namespace parameter 1",
        "/configfile": text, "/binaryfile": text.encode(), "/commandoutput": text,
        "/commandoutputinteger": 0, "/commandoutputdouble": 10.0, "/commandoutputbool": True,
        "/commandoutputyaml/integer1": 1, "/override": "pass",
    }  # fmt: skip
    assert {name: values[name] for name in expected} == expected
    kinds = {name: type(value) for name, value in expected.items()}
    assert {name: type(values[name]) for name in kinds} == kinds


def test_if_and_unless_choose(stage: Stage) -> None:
    names = set(dumped(stage, f"{XML}/test-if-unless.xml"))
    assert len(names) == 8
    assert all(name.endswith("_pass") for name in names)
    assert sum(name.startswith("/py_") for name in names) == 4


def test_files_nodes_and_arguments_are_listed(stage: Stage) -> None:
    files = stage.run("roslaunch --files roslaunch test-env.xml").stdout.split()
    assert [Path(file).name for file in files] == ["test-env.xml", "test-env-include.xml"]
    nodes = stage.run(f"roslaunch --nodes {XML}/test-node-valid.xml").stdout.split()
    assert "/n1" in nodes
    arguments = stage.run("roslaunch --ros-args test_roslaunch ros_args.launch").stdout
    for line in ("Required Arguments:", "bar: Someone walks into this.", "nop: undocumented",
                 "Optional Arguments:", """foo (default "true"): I pity the foo'.""",
                 'baz (default "false"): undocumented'):  # fmt: skip
        assert line in arguments, arguments
    assert "fix" not in arguments


def test_arguments_reach_what_is_included(stage: Stage) -> None:
    values = dumped(stage, f"{XML}/test-arg-all.xml required:=test_arg")
    assert values["/p3_test"] == "parent"
    assert values["/all/include_test/p3_test"] == "set"
    assert values["/all_override/include_test/p1_test"] == "override"
    missing = refused(stage, "test-arg-all.xml").output
    assert "RLException: [" in missing
    assert "test-arg-all.xml] requires the 'required' arg to be set" in missing


def test_63_invalid_files_do_not_load(stage: Stage) -> None:
    names = sorted(path.name for path in (stage.folder / XML).glob("*invalid*"))
    assert len(names) == 65
    for name in names:
        if name in LOAD:
            assert dumped(stage, f"{XML}/{name}") == {}
        else:
            said = refused(stage, name).output
            assert f"{name}:" in said or "test-arg-invalid-included.xml:" in said, said


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("test-if-unless-invalid-both.xml", "cannot set both 'if' and 'unless' on the same tag"),
        ("not-launch.xml", "Invalid roslaunch XML syntax: no root <launch> tag"),
        ("test-arg-invalid-redecl.xml", "arg 'grounded' has already been declared"),
    ],
)
def test_errors_have_the_words_of_roslaunch(stage: Stage, name: str, text: str) -> None:
    assert text in refused(stage, name).output


def test_the_launch_of_no_nodes_sets_its_parameter_and_ends(stage: Stage) -> None:
    # The stage's graph is the core that is running.
    ran = stage.run("roslaunch roslaunch noop.launch", timeout_s=30.0)
    assert ran.code == 0, ran.output
    assert stage.run("rosparam get /noop").stdout.strip() == "noop"


@pytest.mark.parametrize(
    ("words", "missing"),
    [
        # The inside of the commands roslaunch and rosparam is not there, and says so.
        ("test_roslaunch roslaunch.test", "No module named 'roslaunch.arg_dump': gazelle: it is"),
        ("test_roslaunch env.test", ""),
        ("test_roslaunch params_basic.test", ""),
        ("test_rosparam rosparam.test", "no attribute 'yamlmain': gazelle: it is the inside"),
    ],
)
def test_the_packages_own_rostests_pass(stage: Stage, words: str, missing: str) -> None:
    ran = stage.run(f"rostest {words}", timeout_s=120.0, traceback=True)
    assert "passed]" in ran.stdout, ran.output
    failed = re.split(r"^\[.*\]\[(?:ERROR|FAILURE)\]-+$", ran.output, flags=re.M)[1:]
    if not missing:
        assert (ran.code, failed) == (0, []), ran.output
    # _fullusage is one of those insides as well.
    assert all(missing in one or "_fullusage" in one for one in failed), ran.output
    assert not [one for one in failed if "Online" in one.splitlines()[0]], ran.output
