"""The PR2 tutorial's controller as a rosbuild package of 2011, written for a test."""

from __future__ import annotations

import re
from pathlib import Path
from textwrap import dedent

__all__ = ["INIT", "PYTHON_TWIN", "init_of_document", "write_controller_package"]

MANIFEST = """\
<package>
  <description brief="my_controller_pkg">A controller that turns a wheel.</description>
  <author>someone</author>
  <license>BSD</license>
  <depend package="pr2_controller_interface"/>
  <depend package="pr2_mechanism_model"/>
  <depend package="control_toolbox"/>
  <depend package="pluginlib"/>
  <depend package="std_msgs"/>
  <export>
    <pr2_controller_interface plugin="${prefix}/controller_plugins.xml" />
  </export>
</package>
"""
CMAKE_LISTS = """\
cmake_minimum_required(VERSION 2.4.6)
include($ENV{ROS_ROOT}/core/rosbuild/rosbuild.cmake)

# Set the build type.
#set(ROS_BUILD_TYPE RelWithDebInfo)

rosbuild_init()

#set the default path for built executables to the "bin" directory
set(EXECUTABLE_OUTPUT_PATH ${PROJECT_SOURCE_DIR}/bin)
#set the default path for built libraries to the "lib" directory
set(LIBRARY_OUTPUT_PATH ${PROJECT_SOURCE_DIR}/lib)

rosbuild_add_library(my_controller_lib src/my_controller_file.cpp)
"""
MAKEFILE = "include $(shell rospack find mk)/cmake.mk\n"
PLUGINS = """\
<library path="lib/libmy_controller_lib">
  <class name="MyControllerPlugin"
         type="my_controller_ns::MyControllerClass"
         base_class_type="pr2_controller_interface::Controller" />
</library>
"""
HEADER = """\
#include <pr2_controller_interface/controller.h>
#include <pr2_mechanism_model/joint.h>
#include <control_toolbox/pid.h>
#include <std_msgs/Float64.h>

namespace my_controller_ns{

class MyControllerClass: public pr2_controller_interface::Controller
{
private:
  pr2_mechanism_model::JointState* wheel1_state;
  pr2_mechanism_model::JointState* wheel2_state;
  pr2_mechanism_model::RobotState *robot_;
  control_toolbox::Pid pid_;
  ros::Time time_of_last_cycle_;
  ros::Subscriber sub_;
  double angle_;
  double speed_;

  void commandCB(const std_msgs::Float64ConstPtr& msg);

public:
  virtual bool init(pr2_mechanism_model::RobotState *robot,
                   ros::NodeHandle &n);
  virtual void starting();
  virtual void update();
  virtual void stopping();
};
}
"""
INIT = """\
bool MyControllerClass::init(pr2_mechanism_model::RobotState *robot,
                            ros::NodeHandle &n)
{
  const char* keys[] = {"wheel1", "wheel2"};
  pr2_mechanism_model::JointState** states[] = {&wheel1_state, &wheel2_state};
  for (int i = 0; i < 2; ++i)
  {
    std::string name;
    if (!n.getParam(keys[i], name))
    {
      ROS_ERROR("No joint given in namespace: '%s')", n.getNamespace().c_str());
      return false;
    }
    *states[i] = robot->getJointState(name);
    if (!*states[i])
    {
      ROS_ERROR("MyController could not find joint named '%s'", name.c_str());
      return false;
    }
  }
"""
REST = """\
  if (!pid_.init(ros::NodeHandle(n, "pid_steer")))
  {
    ROS_ERROR("MyController could not construct PID controller for wheel '%s'",
              wheel1_state->joint_->name.c_str());
    return false;
  }
  sub_ = n.subscribe<std_msgs::Float64>("command", 1, &MyControllerClass::commandCB, this);
  robot_ = robot;
  speed_ = 0.5;
  return true;
}

void MyControllerClass::commandCB(const std_msgs::Float64ConstPtr& msg)
{
  speed_ = msg->data;
}

/// Controller startup in realtime
void MyControllerClass::starting()
{
  angle_ = wheel1_state->position_;
  time_of_last_cycle_ = robot_->getTime();
  pid_.reset();
}

/// Controller update loop in realtime
void MyControllerClass::update()
{
  ros::Duration dt = robot_->getTime() - time_of_last_cycle_;
  time_of_last_cycle_ = robot_->getTime();
  angle_ += speed_ * dt.toSec();
  wheel1_state->commanded_effort_ = pid_.updatePid(wheel1_state->position_ - angle_, dt);
}

/// Controller stopping in realtime
void MyControllerClass::stopping()
{}
} // namespace

/// Register controller to pluginlib
PLUGINLIB_DECLARE_CLASS(my_controller_pkg,MyControllerPlugin,
                         my_controller_ns::MyControllerClass,
                         pr2_controller_interface::Controller)
"""
PYTHON_TWIN = """
from gazelle.control import Pid


class MyControllerPlugin:
    def init(self, robot, n):
        self.robot = robot
        self.wheels = [robot.getJointState(n.getParam(key)) for key in ("wheel1", "wheel2")]
        self.pid = Pid()
        return self.pid.init(n, "pid_steer")

    def starting(self):
        self.angle = self.wheels[0].position_
        self.last = self.robot.getTime()
        self.pid.reset()

    def update(self):
        now = self.robot.getTime()
        dt, self.last = now - self.last, now
        self.angle += 0.5 * dt.to_sec()
        wheel = self.wheels[0]
        wheel.commanded_effort_ = self.pid.updatePid(wheel.position_ - self.angle, dt)
"""
_LINE = re.compile(r"^\s{0,3}(\d+) ?(.*)$")


def init_of_document(text: str) -> str:
    """Return what the document prints of ``init``, without its line numbers and dots."""
    begin = text.index("bool MyControllerClass::init")
    lines = []
    for line in text[text.rindex("\n", 0, begin) + 1 :].splitlines():
        found = _LINE.match(line)
        if found is None or found.group(2) == "...":
            break
        lines.append(found.group(2))
    return "\n".join(lines) + "\n"


def write_controller_package(
    folder: Path, init: str = INIT, name: str = "my_controller_pkg"
) -> Path:
    """Write the package into a folder of packages; its `init` is completed."""
    package = folder / name
    (package / "src").mkdir(parents=True)
    include = package / "include" / name
    include.mkdir(parents=True)
    (package / "manifest.xml").write_text(MANIFEST)
    (package / "CMakeLists.txt").write_text(CMAKE_LISTS)
    (package / "Makefile").write_text(MAKEFILE)
    (package / "controller_plugins.xml").write_text(PLUGINS)
    (include / "my_controller_file.h").write_text(HEADER)
    source = dedent(f"""\
        #include "{name}/my_controller_file.h"
        #include <pluginlib/class_list_macros.h>

        namespace my_controller_ns {{

        """)
    (package / "src" / "my_controller_file.cpp").write_text(source + init + REST)
    return package
