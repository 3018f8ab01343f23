"""A package of ROS 1 with C++ that answers, that crashes and that does not compile."""

from __future__ import annotations

__all__ = ["FILES", "LAUNCH"]

_LISTS = """cmake_minimum_required(VERSION 3.0.2)
project(answers)
find_package(catkin REQUIRED COMPONENTS roscpp std_msgs)
catkin_package()
include_directories(${catkin_INCLUDE_DIRS})
add_executable(answerer src/answerer.cpp)
target_link_libraries(answerer ${catkin_LIBRARIES})
add_executable(falls src/falls.cpp)
target_link_libraries(falls ${catkin_LIBRARIES})
add_executable(bad src/bad.cpp)
target_link_libraries(bad ${catkin_LIBRARIES})
install(TARGETS answerer RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
"""
_MANIFEST = """<package format="2">
  <name>answers</name><version>1.0.0</version><description>Answers.</description>
  <maintainer email="a@example.org">a</maintainer><license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
  <depend>roscpp</depend><depend>std_msgs</depend><exec_depend>rospy</exec_depend>
</package>
"""
_ANSWERER = """#include <ros/ros.h>
#include <std_msgs/String.h>

ros::Publisher answers;

void answer(const std_msgs::String::ConstPtr& question) {
  std_msgs::String message;
  message.data = question->data + "!";
  answers.publish(message);
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "answerer");
  ros::NodeHandle node;
  answers = node.advertise<std_msgs::String>("answers", 10, true);
  ros::Subscriber questions = node.subscribe("questions", 10, answer);
  ros::Subscriber ends = node.subscribe<std_msgs::String>(
      "end", 1, [&](const std_msgs::String::ConstPtr&) { ros::requestShutdown(); });
  ROS_INFO("ready to answer");
  ros::spin();
  printf("answerer ends\\n");
  return 0;
}
"""
_FALLS = """#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "falls");
  ros::NodeHandle node;
  raise(SIGSEGV);
  return 0;
}
"""
_BAD = """#include <ros/ros.h>

int main() {
  return no_such_name;
}
"""
_ASKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import String

rospy.init_node("asker")
questions = rospy.Publisher("questions", String, queue_size=1)
ends = rospy.Publisher("end", String, queue_size=1, latch=True)
heard = []
rospy.Subscriber("answers", String, lambda message: heard.append(message.data))
rate = rospy.Rate(20)
while not heard and not rospy.is_shutdown():
    questions.publish("who are you")
    rate.sleep()
print("python heard", *heard[:1], flush=True)
ends.publish("")
while ends.get_num_connections() and not rospy.is_shutdown():
    rate.sleep()
"""

FILES = {
    "answers/CMakeLists.txt": _LISTS,
    "answers/package.xml": _MANIFEST,
    "answers/src/answerer.cpp": _ANSWERER,
    "answers/src/falls.cpp": _FALLS,
    "answers/src/bad.cpp": _BAD,
    "answers/scripts/asker.py": _ASKER,
}
"""Every file of the package, by its path below ``src``."""

LAUNCH = """<launch>
  <node pkg="answers" type="falls" name="falls" output="screen"/>
  <node pkg="answers" type="answerer" name="answerer" output="screen"/>
  <node pkg="answers" type="bad" name="bad" output="screen"/>
  <node pkg="answers" type="asker.py" name="asker" output="screen"/>
</launch>
"""
"""A launch of all of them; it ends when the answer is heard."""
