// A buffer of transforms that can be waited for.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "geometry_msgs/msg/transform_stamped.hpp"
#include "rclcpp/create_service.hpp"
#include "rclcpp/node_interfaces/get_node_base_interface.hpp"
#include "rclcpp/node_interfaces/get_node_logging_interface.hpp"
#include "rclcpp/node_interfaces/get_node_services_interface.hpp"
#include "rclcpp/rclcpp.hpp"
#include "tf2/buffer_core.hpp"
#include "tf2/time.hpp"
#include "tf2_msgs/srv/frame_graph.hpp"
#include "tf2_ros/async_buffer_interface.hpp"
#include "tf2_ros/buffer_interface.hpp"
#include "tf2_ros/create_timer_interface.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

class TF2_ROS_PUBLIC Buffer : public BufferInterface,
                              public AsyncBufferInterface,
                              public tf2::BufferCore {
 public:
  using tf2::BufferCore::canTransform;
  using tf2::BufferCore::lookupTransform;
  using SharedPtr = std::shared_ptr<tf2_ros::Buffer>;

  // With a node, its service tf2_frames tells all frames.
  template <typename NodeT = rclcpp::Node::SharedPtr>
  Buffer(rclcpp::Clock::SharedPtr clock,
         tf2::Duration cache_time = tf2::Duration(tf2::BUFFER_CORE_DEFAULT_CACHE_TIME),
         NodeT&& node = NodeT(), const rclcpp::QoS& qos = rclcpp::ServicesQoS())
      : BufferCore(cache_time), clock_(std::move(clock)) {
    begin();
    if (!node) return;
    namespace interfaces = rclcpp::node_interfaces;
    logging_ = interfaces::get_node_logging_interface(node);
    using Graph = tf2_msgs::srv::FrameGraph;
    std::function<void(const std::shared_ptr<Graph::Request>, std::shared_ptr<Graph::Response>)>
        tell = [this](const std::shared_ptr<Graph::Request>,
                      std::shared_ptr<Graph::Response> response) {
          response->frame_yaml = allFramesAsYAML();
        };
    frames_server_ = rclcpp::create_service<Graph>(interfaces::get_node_base_interface(node),
                                                   interfaces::get_node_services_interface(node),
                                                   "tf2_frames", std::move(tell), qos, nullptr);
  }
  ~Buffer() override;

  TransformStamped lookupTransform(const std::string& target_frame, const std::string& source_frame,
                                   const tf2::TimePoint& time,
                                   const tf2::Duration timeout) const override;
  TransformStamped lookupTransform(const std::string& target_frame,
                                   const tf2::TimePoint& target_time,
                                   const std::string& source_frame,
                                   const tf2::TimePoint& source_time,
                                   const std::string& fixed_frame,
                                   const tf2::Duration timeout) const override;
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const tf2::TimePoint& target_time, const tf2::Duration timeout,
                    std::string* errstr = nullptr) const override;
  bool canTransform(const std::string& target_frame, const tf2::TimePoint& target_time,
                    const std::string& source_frame, const tf2::TimePoint& source_time,
                    const std::string& fixed_frame, const tf2::Duration timeout,
                    std::string* errstr = nullptr) const override;
  TransformStampedFuture waitForTransform(const std::string& target_frame,
                                          const std::string& source_frame,
                                          const tf2::TimePoint& time, const tf2::Duration& timeout,
                                          TransformReadyCallback callback) override;
  void cancel(const TransformStampedFuture& ts_future) override;

  // The same with rclcpp's times.
  TransformStamped lookupTransform(
      const std::string& target_frame, const std::string& source_frame, const rclcpp::Time& time,
      const rclcpp::Duration timeout = rclcpp::Duration::from_nanoseconds(0)) const {
    return lookupTransform(target_frame, source_frame, fromRclcpp(time), fromRclcpp(timeout));
  }
  TransformStamped lookupTransform(
      const std::string& target_frame, const rclcpp::Time& target_time,
      const std::string& source_frame, const rclcpp::Time& source_time,
      const std::string& fixed_frame,
      const rclcpp::Duration timeout = rclcpp::Duration::from_nanoseconds(0)) const {
    return lookupTransform(target_frame, fromRclcpp(target_time), source_frame,
                           fromRclcpp(source_time), fixed_frame, fromRclcpp(timeout));
  }
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const rclcpp::Time& time,
                    const rclcpp::Duration timeout = rclcpp::Duration::from_nanoseconds(0),
                    std::string* errstr = nullptr) const {
    return canTransform(target_frame, source_frame, fromRclcpp(time), fromRclcpp(timeout), errstr);
  }
  bool canTransform(const std::string& target_frame, const rclcpp::Time& target_time,
                    const std::string& source_frame, const rclcpp::Time& source_time,
                    const std::string& fixed_frame,
                    const rclcpp::Duration timeout = rclcpp::Duration::from_nanoseconds(0),
                    std::string* errstr = nullptr) const {
    return canTransform(target_frame, fromRclcpp(target_time), source_frame,
                        fromRclcpp(source_time), fixed_frame, fromRclcpp(timeout), errstr);
  }
  TransformStampedFuture waitForTransform(const std::string& target_frame,
                                          const std::string& source_frame, const rclcpp::Time& time,
                                          const rclcpp::Duration& timeout,
                                          TransformReadyCallback callback) {
    return waitForTransform(target_frame, source_frame, fromRclcpp(time), fromRclcpp(timeout),
                            std::move(callback));
  }

  void setCreateTimerInterface(CreateTimerInterface::SharedPtr create_timer_interface) {
    timers_ = std::move(create_timer_interface);
  }

 private:
  struct Wait;

  void begin();
  bool has_thread(std::string* errstr) const;
  // `why` empty: it came.
  void end_waiting(const std::shared_ptr<Wait>& wait, const std::string& why);
  rclcpp::Logger logger() const;

  rclcpp::Service<tf2_msgs::srv::FrameGraph>::SharedPtr frames_server_;
  rclcpp::Clock::SharedPtr clock_;
  rclcpp::node_interfaces::NodeLoggingInterface::SharedPtr logging_;
  CreateTimerInterface::SharedPtr timers_;
  rclcpp::JumpHandler::SharedPtr jump_;
  std::mutex waits_lock_;
  std::unordered_map<tf2::TransformableRequestHandle, std::shared_ptr<Wait>> waits_;
};

static const char threading_error[] =
    "Do not call canTransform or lookupTransform with a timeout unless you are using another "
    "thread for populating data. Without a dedicated thread it will always timeout.  If you have "
    "a separate thread servicing tf messages, call setUsingDedicatedThread(true) on your Buffer "
    "instance.";

}  // namespace tf2_ros
