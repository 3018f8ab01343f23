#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "interactive_markers/tools.hpp"
#include "rclcpp/rclcpp.hpp"
#include "visualization_msgs/msg/interactive_marker_feedback.hpp"
#include "visualization_msgs/msg/interactive_marker_update.hpp"
#include "visualization_msgs/srv/get_interactive_markers.hpp"

namespace interactive_markers {

using FeedbackConstPtr = visualization_msgs::msg::InteractiveMarkerFeedback::ConstSharedPtr;
using FeedbackCallback = std::function<void(const FeedbackConstPtr&)>;
using HeaderMsg = std_msgs::msg::Header;
using InteractiveMarkerFeedback = visualization_msgs::msg::InteractiveMarkerFeedback;
using InteractiveMarkerPose = visualization_msgs::msg::InteractiveMarkerPose;
using InteractiveMarkerUpdate = visualization_msgs::msg::InteractiveMarkerUpdate;
using MenuEntry = visualization_msgs::msg::MenuEntry;
using PoseMsg = geometry_msgs::msg::Pose;
inline bool has_stamp(const HeaderMsg& header) {
  return header.stamp.sec != 0 || header.stamp.nanosec != 0;
}

#include "gazelle/interactive_markers/server_core.inc"

// Offers markers that people move and press; changes are seen after applyChanges().
class InteractiveMarkerServer {
 public:
  typedef visualization_msgs::msg::InteractiveMarkerFeedback::ConstSharedPtr FeedbackConstPtr;
  typedef interactive_markers::FeedbackCallback FeedbackCallback;
  static const std::uint8_t DEFAULT_FEEDBACK_CB = 255;

  template <class NodePtr>
  InteractiveMarkerServer(const std::string& topic_namespace, NodePtr node,
                          const rclcpp::QoS& update_pub_qos = rclcpp::QoS(100),
                          const rclcpp::QoS& feedback_sub_qos = rclcpp::QoS(1))
      : InteractiveMarkerServer(
            topic_namespace, node->get_node_base_interface(), node->get_node_clock_interface(),
            node->get_node_logging_interface(), node->get_node_topics_interface(),
            node->get_node_services_interface(), update_pub_qos, feedback_sub_qos) {}

  InteractiveMarkerServer(
      const std::string& topic_namespace,
      rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base_interface,
      rclcpp::node_interfaces::NodeClockInterface::SharedPtr clock_interface,
      rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr /*logging_interface*/,
      rclcpp::node_interfaces::NodeTopicsInterface::SharedPtr topics_interface,
      rclcpp::node_interfaces::NodeServicesInterface::SharedPtr services_interface,
      const rclcpp::QoS& update_pub_qos = rclcpp::QoS(100),
      const rclcpp::QoS& feedback_sub_qos = rclcpp::QoS(1))
      : context_(base_interface->get_context()), clock_(clock_interface->get_clock()) {
    using visualization_msgs::srv::GetInteractiveMarkers;
    update_ = rclcpp::create_publisher<InteractiveMarkerUpdate>(
        topics_interface, topic_namespace + "/update", update_pub_qos);
    feedback_ = rclcpp::create_subscription<InteractiveMarkerFeedback>(
        topics_interface, topic_namespace + "/feedback", feedback_sub_qos,
        [this](InteractiveMarkerFeedback::ConstSharedPtr message) {
          core_.feedback(message, clock_->now().seconds());
        });
    service_ = rclcpp::create_service<GetInteractiveMarkers>(
        base_interface, services_interface, topic_namespace + "/get_interactive_markers",
        [this](const std::shared_ptr<rmw_request_id_t>,
               const std::shared_ptr<GetInteractiveMarkers::Request>,
               std::shared_ptr<GetInteractiveMarkers::Response> response) {
          const std::lock_guard<std::recursive_mutex> lock(core_.mutex);
          response->sequence_number = core_.sequence;
          core_.all(response->markers);
        },
        rclcpp::ServicesQoS(), base_interface->get_default_callback_group());
  }
  ~InteractiveMarkerServer() {
    if (!rclcpp::ok(context_)) return;
    clear();
    applyChanges();
  }
  InteractiveMarkerServer(const InteractiveMarkerServer&) = delete;
  InteractiveMarkerServer& operator=(const InteractiveMarkerServer&) = delete;

  void insert(const InteractiveMarker& marker) { core_.insert(marker); }
  void insert(const InteractiveMarker& marker, FeedbackCallback feedback_callback,
              std::uint8_t feedback_type = DEFAULT_FEEDBACK_CB) {
    insert(marker);
    setCallback(marker.name, feedback_callback, feedback_type);
  }
  bool setPose(const std::string& name, const PoseMsg& pose,
               const HeaderMsg& header = HeaderMsg()) {
    return core_.set_pose_of(name, pose, header);
  }
  bool erase(const std::string& name) { return core_.erase(name); }
  void clear() { core_.clear(); }
  bool empty() const { return size() == 0; }
  std::size_t size() const { return core_.size(); }
  // An empty callback takes the one away that is there.
  bool setCallback(const std::string& name, FeedbackCallback feedback_cb,
                   std::uint8_t feedback_type = DEFAULT_FEEDBACK_CB) {
    return core_.set_callback(name, feedback_cb, feedback_type);
  }
  void applyChanges() {
    const std::lock_guard<std::recursive_mutex> lock(core_.mutex);
    InteractiveMarkerUpdate update;
    if (!core_.apply(update)) return;
    update.type = InteractiveMarkerUpdate::UPDATE;
    update.seq_num = core_.sequence;
    update_->publish(update);
  }
  bool get(std::string name, InteractiveMarker& marker) const { return core_.get(name, marker); }

 private:
  mutable detail::ServerCore core_;
  rclcpp::Context::SharedPtr context_;
  rclcpp::Clock::SharedPtr clock_;
  rclcpp::Publisher<InteractiveMarkerUpdate>::SharedPtr update_;
  rclcpp::Subscription<InteractiveMarkerFeedback>::SharedPtr feedback_;
  rclcpp::Service<visualization_msgs::srv::GetInteractiveMarkers>::SharedPtr service_;
};

}  // namespace interactive_markers
