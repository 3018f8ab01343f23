"""A package with a plug-in of rqt, as people write them."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = """<package format="2">
  <name>rqt_arm</name><version>0.1.0</version><description>Arm</description>
  <maintainer email="a@b.c">A</maintainer><license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend>
  <export><rqt_gui plugin="${prefix}/plugin.xml"/></export>
</package>
"""
_PLUGIN = """<library path="src">
  <class name="ArmTester" type="rqt_arm.arm_tester.ArmTesterPlugin"
         base_class_type="rqt_gui_py::Plugin">
    <description>Moves the arm.</description>
    <qtgui><label>Arm Tester</label></qtgui>
  </class>
</library>
"""
_SOURCE = """import os
import rospkg
from rqt_gui_py.plugin import Plugin
from python_qt_binding import loadUi
from python_qt_binding.QtWidgets import QWidget


class ArmTesterPlugin(Plugin):
    def __init__(self, context):
        super().__init__(context)
        self._widget = QWidget()
        path = rospkg.RosPack().get_path("rqt_arm")
        loadUi(os.path.join(path, "resource", "arm_tester.ui"), self._widget)
"""
UI = """<?xml version="1.0" encoding="UTF-8"?>
<ui version="4.0">
 <class>Form</class>
 <widget class="QWidget" name="Form">
  <property name="windowTitle"><string>Arm</string></property>
  <layout class="QVBoxLayout" name="all">
   <item>
    <widget class="QGroupBox" name="group">
     <property name="title"><string>Speed</string></property>
     <layout class="QHBoxLayout" name="line">
      <item>
       <widget class="QSlider" name="speed_slider">
        <property name="maximum"><number>50</number></property>
        <property name="orientation"><enum>Qt::Horizontal</enum></property>
       </widget>
      </item>
      <item>
       <widget class="QDoubleSpinBox" name="gain">
        <property name="suffix"><string> Nm</string></property>
        <property name="maximum"><double>2.500000000000000</double></property>
        <property name="singleStep"><double>0.100000000000000</double></property>
       </widget>
      </item>
     </layout>
    </widget>
   </item>
   <item>
    <widget class="QPushButton" name="go-button">
     <property name="text"><string>&amp;Go</string></property>
    </widget>
   </item>
   <item>
    <widget class="QComboBox" name="mode">
     <item><property name="text"><string>fast</string></property></item>
     <item><property name="text"><string>slow</string></property></item>
    </widget>
   </item>
   <item><widget class="QGraphicsView" name="drawing"/></item>
   <item>
    <widget class="QTableWidget" name="joints">
     <column><property name="text"><string>Joint</string></property></column>
     <column><property name="text"><string>Angle</string></property></column>
    </widget>
   </item>
  </layout>
 </widget>
</ui>
"""


def write_package(root: Path, *, source: bool = True) -> Path:
    """Write the package ``rqt_arm`` below a folder and return its own."""
    folder = root / "rqt_arm"
    (folder / "src" / "rqt_arm").mkdir(parents=True)
    (folder / "resource").mkdir()
    (folder / "package.xml").write_text(_PACKAGE)
    (folder / "plugin.xml").write_text(_PLUGIN)
    (folder / "resource" / "arm_tester.ui").write_text(UI)
    (folder / "resource" / "other.ui").write_text(UI.replace("speed_slider", "other_slider"))
    if source:
        (folder / "src" / "rqt_arm" / "__init__.py").write_text("")
        (folder / "src" / "rqt_arm" / "arm_tester.py").write_text(_SOURCE)
    return folder
