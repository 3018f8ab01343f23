"""Files at the places where installing a source package would put them."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.xacro.expander import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.workspace.installed_files import installed_source

LISTS = """cmake_minimum_required(VERSION 3.8)
project(courier)  # install(DIRECTORY wrong DESTINATION share/courier)
install(
  DIRECTORY description/urdf bringup/config launch
  DESTINATION share/${PROJECT_NAME}
)
install(DIRECTORY arms/six/ DESTINATION "share/${PROJECT_NAME}/arm")
install(DIRECTORY include/ DESTINATION include)
install(FILES description/notes.md DESTINATION share/courier/doc RENAME README.md)
install(PROGRAMS tools/a.py tools/b.py DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/bin)
ament_auto_package(INSTALL_TO_SHARE extra/worlds)
"""
FILES = {
    "urdf/courier.urdf.xacro": "description/urdf/courier.urdf.xacro",
    "config/wheels.yaml": "bringup/config/wheels.yaml",
    "arm/joints/one.yaml": "arms/six/joints/one.yaml",
    "doc/README.md": "description/notes.md",
    "bin/b.py": "tools/b.py",
    "worlds/yard.world": "extra/worlds/yard.world",
}
MACRO = """<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:macro name="wheel"><link name="wheel"/></xacro:macro></robot>"""
MAIN = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find courier)/urdf/wheel.xacro"/><xacro:wheel/>
  <xacro:property name="file" value="$(find courier)/config/wheels.yaml"/>
  <xacro:property name="all" value="${xacro.load_yaml(file)}"/>
  <link name="${all['x']}"/></robot>"""


@pytest.fixture
def courier(make_package, tmp_path: Path) -> Path:
    folder: Path = make_package(tmp_path / "src" / "courier_robot", "courier", tool="ament_cmake")
    (folder / "CMakeLists.txt").write_text(LISTS)
    for source in FILES.values():
        (folder / source).parent.mkdir(parents=True, exist_ok=True)
        (folder / source).write_text("x: 2")
    return folder


@pytest.mark.parametrize("place", FILES)
def test_file_is_found_where_its_install_rule_takes_it_from(courier: Path, place: str) -> None:
    assert installed_source(courier / place) == courier / FILES[place]


@pytest.mark.parametrize("place", ["urdf/other.urdf", "urdfs", "wrong/a", "joints/one.yaml"])
def test_nothing_is_found_where_nothing_is_installed(courier: Path, place: str) -> None:
    assert installed_source(courier / place) is None


def test_addresses_mean_the_share_folder(courier: Path, discover) -> None:
    workspace = discover(extra=(courier.parent,))
    for uri in ("package://courier/", "$(find courier)/", f"{courier}/"):
        found = workspace.resolve(f"{uri}config/wheels.yaml")
        assert found.path == courier / "bringup/config/wheels.yaml"


def test_xacro_includes_and_loads_what_is_installed_elsewhere(courier: Path, discover) -> None:
    macro = courier / "description/urdf/wheel.xacro"
    macro.write_text(MACRO)
    main = courier / "description/urdf/courier.urdf.xacro"
    main.write_text(MAIN)
    diagnostics = Diagnostics()
    found = expand_xacro(main, workspace=discover(extra=(courier.parent,)), diagnostics=diagnostics)
    assert not list(diagnostics)
    assert found is not None
    assert 'name="wheel"' in found.text and 'name="2"' in found.text
    assert str(macro) in found.dependencies
