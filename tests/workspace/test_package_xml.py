from __future__ import annotations

import pytest

from gazelle.workspace.package_xml import ManifestError, read_manifest


def read(tmp_path, text, name="package.xml"):
    (tmp_path / name).write_text(text)
    return read_manifest(tmp_path / name)


@pytest.mark.parametrize(
    ("inside", "build_type"),
    [
        ("<buildtool_depend>catkin</buildtool_depend>", "catkin"),
        ("<buildtool_depend>ament_cmake</buildtool_depend>", "ament_cmake"),
        ("<export><build_type>ament_python</build_type></export>", "ament_python"),
        ("<export><build_type>cmake</build_type></export>", "cmake"),
        ("", "catkin"),
    ],
)
def test_the_build_type_follows_rep_149(tmp_path, inside, build_type):
    text = f'<package format="3"><name>a</name>{inside}</package>'
    manifest = read(tmp_path, text)
    assert (manifest.format, manifest.build_type) == (3, build_type)


def test_rosbuild_manifests_are_read(tmp_path):
    text = '<package><depend package="roscpp"/><depend package="gazebo"/></package>'
    manifest = read(tmp_path, text, "manifest.xml")
    assert (manifest.format, manifest.build_type) == (0, "rosbuild")
    assert manifest.depends == ("gazebo", "roscpp")


def test_entities_are_refused(tmp_path):
    with pytest.raises(ManifestError, match=r"entities are refused \('x'\)"):
        read(tmp_path, '<!DOCTYPE p [<!ENTITY x "y">]><package><name>&x;</name></package>')


def test_another_documents_root_is_refused(tmp_path):
    with pytest.raises(ManifestError, match="the root element is <robot>, not <package>"):
        read(tmp_path, "<robot/>")


def test_a_missing_file_says_so(tmp_path):
    with pytest.raises(ManifestError, match="No such file"):
        read_manifest(tmp_path / "package.xml")
