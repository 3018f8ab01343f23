from __future__ import annotations

import pytest


def make(folder, relative: str, text: str = "#!/usr/bin/env python3\n", mode: int = 0o644):
    path = folder / relative
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(mode)
    return path


@pytest.fixture
def package(tmp_path, make_package, discover):
    export = '<gazebo_ros gazebo_model_path="${prefix}/models:${prefix}/more"/><x a="1">t</x>'
    make_package(tmp_path / "src/alpha", export=export)
    return discover(tmp_path).package("alpha")


def test_the_manifest_is_read(package):
    assert (package.version, package.format, package.build_type) == ("1.2.3", 2, "catkin")
    assert package.depends == ("catkin", "roscpp")
    assert package.description == "A package."
    assert package.exports[1] == ("x", (("a", "1"),), "t")


def test_exported_paths_have_their_prefix_replaced(package):
    paths = package.exported_paths("gazebo_ros", "gazebo_model_path")
    assert paths == (package.path / "models", package.path / "more")


@pytest.mark.parametrize("folder", ["scripts", "nodes", "bin", "src", "alpha", "."])
def test_scripts_are_found_in_every_usual_folder(package, folder):
    path = make(package.path, f"{folder}/talk.py")
    assert package.find_executables("talk.py") == (path,)
    assert package.find_executables("talk") == (path,)


def test_deeper_scripts_are_found_last(package):
    path = make(package.path, "tools/deep/talk.py")
    assert package.find_executables("talk.py") == (path,)
    assert package.find_executables("absent") == ()


SETUP = """
from setuptools import setup
package_name = "alpha"
raise SystemExit("setup.py must not be run")
setup(name=package_name, entry_points={"console_scripts": [
    "talk = alpha.talker:main", f"listen = {package_name}.listener:main",
    "sub=" + package_name + ".sub:main"]})
"""


def test_console_scripts_of_setup_py_lead_to_their_module(package):
    make(package.path, "setup.py", SETUP)
    files = {name: make(package.path, f"alpha/{name}.py") for name in ("talker", "listener")}
    sub = make(package.path, "alpha/sub/__init__.py")
    assert package.find_executables("talk") == (files["talker"],)
    assert package.find_executables("listen") == (files["listener"],)
    assert package.find_executables("sub") == (sub,)


def test_console_scripts_of_setup_cfg_and_pyproject_are_read(package):
    make(
        package.path,
        "setup.cfg",
        "[options.entry_points]\nconsole_scripts =\n  a = alpha.one:main\n",
    )
    make(package.path, "pyproject.toml", '[project.scripts]\nb = "alpha.two:main"\n')
    one, two = make(package.path, "alpha/one.py"), make(package.path, "src/alpha/two.py")
    assert package.find_executables("a") == (one,)
    assert package.find_executables("b") == (two,)


def test_a_setup_file_that_cannot_be_parsed_gives_nothing(package):
    make(package.path, "setup.py", "setup(")
    assert package.find_executables("talk") == ()


def test_a_script_does_not_stand_in_for_the_compiled_program_of_its_name(package):
    path = make(package.path, "scripts/talk.py")
    make(package.path, "CMakeLists.txt", "add_executable(talk src/talk.cpp)\n")
    assert package.find_executables("talk") == ()
    assert package.find_executables("talk.py") == (path,)


def test_executable_names_are_what_rosrun_offers(package):
    make(package.path, "scripts/a.py")
    make(package.path, "tools/b", mode=0o755)
    make(package.path, "alpha/module.py")
    make(package.path, "setup.py", SETUP)
    assert package.executable_names == ("a.py", "b", "listen", "sub", "talk")


def test_install_trees_offer_lib(tmp_path, make_package, discover):
    make_package(tmp_path / "install/share/beta")
    path = make(tmp_path / "install", "lib/beta/run", mode=0o755)
    package = discover(AMENT_PREFIX_PATH=str(tmp_path / "install")).package("beta")
    assert package.find_executables("run") == (path,)
    assert package.executable_names == ("run",)


def test_files_are_found_by_relative_path(package):
    path = make(package.path, "launch/x.launch")
    assert package.find_file("launch/x.launch") == path
    assert package.find_file("launch/y.launch") is None


def test_the_sample_teleop_is_found_without_a_build(workspaces_dir, discover):
    package = discover(extra=(workspaces_dir,)).package("slam_robot")
    (path,) = package.find_executables("slam_robot_teleop.py")
    assert path == package.path / "scripts/slam_robot_teleop.py"
