"""A package of ROS 2 with C++ that answers and a component, and one that does not compile."""

from __future__ import annotations

__all__ = ["FILES", "LAUNCH"]

_LISTS = """cmake_minimum_required(VERSION 3.8)
project(replies)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(rclcpp_components REQUIRED)
find_package(std_msgs REQUIRED)
add_executable(replier src/replier.cpp)
ament_target_dependencies(replier rclcpp std_msgs)
add_library(doubler SHARED src/doubler.cpp)
ament_target_dependencies(doubler rclcpp rclcpp_components std_msgs)
rclcpp_components_register_nodes(doubler "replies::Doubler")
install(TARGETS replier DESTINATION lib/${PROJECT_NAME})
install(TARGETS doubler LIBRARY DESTINATION lib)
install(PROGRAMS scripts/asker.py DESTINATION lib/${PROJECT_NAME})
ament_package()
"""
_MANIFEST = """<package format="3">
  <name>replies</name><version>1.0.0</version><description>Replies.</description>
  <maintainer email="a@example.org">a</maintainer><license>MIT</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <depend>rclcpp</depend><depend>rclcpp_components</depend><depend>std_msgs</depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
_REPLIER = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

class Replier : public rclcpp::Node {
 public:
  Replier() : Node("replier") {
    declare_parameter("sign", "?");
    replies_ = create_publisher<std_msgs::msg::String>("replies", 10);
    questions_ = create_subscription<std_msgs::msg::String>(
        "questions", 10, [this](const std_msgs::msg::String& question) {
          std_msgs::msg::String reply;
          reply.data = question.data + get_parameter("sign").as_string();
          replies_->publish(reply);
        });
    ends_ = create_subscription<std_msgs::msg::String>(
        "end", rclcpp::QoS(1).transient_local(),
        [](std_msgs::msg::String::ConstSharedPtr) { rclcpp::shutdown(); });
    RCLCPP_INFO(get_logger(), "ready to reply");
  }

 private:
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr replies_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr questions_, ends_;
};

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Replier>());
  rclcpp::shutdown();
  printf("replier ends\\n");
  return 0;
}
"""
_DOUBLER = """#include <rclcpp/rclcpp.hpp>
#include <rclcpp_components/register_node_macro.hpp>
#include <std_msgs/msg/string.hpp>

namespace replies {

class Doubler : public rclcpp::Node {
 public:
  explicit Doubler(const rclcpp::NodeOptions& options) : Node("doubler", options) {
    twice_ = create_publisher<std_msgs::msg::String>("twice", 10);
    once_ = create_subscription<std_msgs::msg::String>(
        "replies", 10, [this](std_msgs::msg::String::UniquePtr message) {
          message->data += message->data;
          twice_->publish(std::move(message));
        });
  }

 private:
  rclcpp::Publisher<std_msgs::msg::String>::SharedPtr twice_;
  rclcpp::Subscription<std_msgs::msg::String>::SharedPtr once_;
};

}  // namespace replies

RCLCPP_COMPONENTS_REGISTER_NODE(replies::Doubler)
"""
_BAD = """#include <rclcpp/rclcpp.hpp>

int main() {
  return no_such_name;
}
"""
_BROKEN = """cmake_minimum_required(VERSION 3.8)
project(broken)
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
add_executable(bad src/bad.cpp)
ament_target_dependencies(bad rclcpp)
install(TARGETS bad DESTINATION lib/${PROJECT_NAME})
ament_package()
"""
_ASKER = """#!/usr/bin/env python3
import sys

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("asker")
latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
questions = node.create_publisher(String, "questions", 1)
ends = node.create_publisher(String, "end", latched)
heard = []
node.create_subscription(String, sys.argv[1], lambda message: heard.append(message.data), 10)
node.create_timer(0.05, lambda: questions.publish(String(data="who")))
while not heard and rclpy.ok():
    rclpy.spin_once(node)
print("python heard", heard[0], flush=True)
ends.publish(String())
while ends.get_subscription_count() and rclpy.ok():
    rclpy.spin_once(node)
"""

FILES = {
    "replies/CMakeLists.txt": _LISTS,
    "replies/package.xml": _MANIFEST,
    "replies/src/replier.cpp": _REPLIER,
    "replies/src/doubler.cpp": _DOUBLER,
    "broken/CMakeLists.txt": _BROKEN,
    "broken/package.xml": _MANIFEST.replace("replies", "broken"),
    "broken/src/bad.cpp": _BAD,
    "replies/scripts/asker.py": _ASKER,
}
"""Every file of the package, and of one that does not compile, by its path below ``src``."""

LAUNCH = """from launch import LaunchDescription
from launch.actions import EmitEvent, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode


def generate_launch_description():
    asker = Node(package="replies", executable="asker.py", arguments=["twice"], output="screen")
    return LaunchDescription([
        Node(package="broken", executable="bad"),
        Node(package="replies", executable="replier", output="screen",
             parameters=[{"sign": "!"}]),
        ComposableNodeContainer(
            package="rclcpp_components", executable="component_container", name="box",
            namespace="", output="screen",
            composable_node_descriptions=[
                ComposableNode(package="replies", plugin="replies::Doubler"),
            ],
        ),
        asker,
        RegisterEventHandler(OnProcessExit(target_action=asker, on_exit=[
            EmitEvent(event=Shutdown(reason="the answer is heard"))])),
    ])
"""
"""A launch of all of them; it ends when the answer is heard."""
