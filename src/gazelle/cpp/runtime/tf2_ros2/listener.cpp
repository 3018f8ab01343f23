#include <algorithm>
#include <atomic>
#include <chrono>
#include <sstream>

#include "tf2_ros/static_transform_broadcaster.hpp"
#include "tf2_ros/transform_broadcaster.hpp"
#include "tf2_ros/transform_listener.hpp"

namespace tf2_ros {

namespace {

// A name that no other listener has, as every node's must be its own.
std::string own_name() {
  static std::atomic<unsigned> count{0};
  std::ostringstream name;
  name << "transform_listener_impl_" << std::hex
       << std::chrono::steady_clock::now().time_since_epoch().count() << count++;
  return name.str();
}

}  // namespace

TransformListener::TransformListener(tf2::BufferCore& buffer, bool spin_thread, bool static_only)
    : buffer_(buffer) {
  rclcpp::NodeOptions options;
  // Remaps of the program's name are not for this node.
  options.arguments({"--ros-args", "-r", "__node:=" + own_name()});
  options.start_parameter_event_publisher(false);
  options.start_parameter_services(false);
  own_node_ = rclcpp::Node::make_shared("_", options);
  node_base_ = own_node_->get_node_base_interface();
  node_logging_ = own_node_->get_node_logging_interface();
  auto moving = detail::get_default_transform_listener_sub_options<>();
  auto still = detail::get_default_transform_listener_static_sub_options<>();
  if (spin_thread) {
    group_ = node_base_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
    moving.callback_group = group_;
    still.callback_group = group_;
  }
  using Message = tf2_msgs::msg::TFMessage;
  if (!static_only)
    moving_ =
        own_node_->create_subscription<Message>("/tf", DynamicListenerQoS(), taker(false), moving);
  static_ = own_node_->create_subscription<Message>("/tf_static", StaticListenerQoS(), taker(true),
                                                    still);
  if (spin_thread) spin();
}

TransformListener::Taker TransformListener::taker(bool is_static) {
  return [this, is_static](tf2_msgs::msg::TFMessage::ConstSharedPtr message) {
    subscription_callback(std::move(message), is_static);
  };
}

void TransformListener::spin() {
  rclcpp::ExecutorOptions options;
  options.context = node_base_->get_context();
  executor_ = std::make_shared<rclcpp::executors::SingleThreadedExecutor>(options);
  executor_->add_callback_group(group_, node_base_);
  buffer_.setUsingDedicatedThread(true);
  thread_ = std::make_unique<std::thread>([this] { executor_->spin(); });
}

TransformListener::~TransformListener() {
  if (!thread_) return;
  executor_->cancel();
  thread_->join();
}

void TransformListener::subscription_callback(tf2_msgs::msg::TFMessage::ConstSharedPtr msg,
                                              bool is_static) {
  for (const geometry_msgs::msg::TransformStamped& one : msg->transforms) {
    try {
      // Who sent it is not told with a message in ROS 2.
      buffer_.setTransform(one, "Authority undetectable", is_static);
    } catch (const tf2::TransformException& error) {
      RCLCPP_ERROR(node_logging_->get_logger(),
                   "Failure to set received transform from %s to %s with error: %s\n",
                   one.child_frame_id.c_str(), one.header.frame_id.c_str(), error.what());
    }
  }
}

void TransformBroadcaster::sendTransform(const geometry_msgs::msg::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::msg::TransformStamped>{transform});
}

void TransformBroadcaster::sendTransform(
    const std::vector<geometry_msgs::msg::TransformStamped>& transforms) {
  tf2_msgs::msg::TFMessage message;
  message.transforms = transforms;
  publisher_->publish(message);
}

void StaticTransformBroadcaster::sendTransform(
    const geometry_msgs::msg::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::msg::TransformStamped>{transform});
}

void StaticTransformBroadcaster::sendTransform(
    const std::vector<geometry_msgs::msg::TransformStamped>& transforms) {
  auto& known = net_message_.transforms;
  for (const geometry_msgs::msg::TransformStamped& one : transforms) {
    const auto place = std::find_if(known.begin(), known.end(), [&](const auto& other) {
      return other.child_frame_id == one.child_frame_id;
    });
    if (place == known.end()) {
      known.push_back(one);
    } else {
      *place = one;
    }
  }
  publisher_->publish(net_message_);
}

}  // namespace tf2_ros
