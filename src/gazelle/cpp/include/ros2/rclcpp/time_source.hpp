#pragma once

#include <memory>

#include "rclcpp/clock.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class Node;

/// Lets clocks of ROS time follow simulated time where a node's use_sim_time says so.
class RCLCPP_PUBLIC TimeSource {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(TimeSource)
  explicit TimeSource(std::shared_ptr<Node> node, const QoS& qos = ClockQoS(),
                      bool use_clock_thread = true);
  explicit TimeSource(const QoS& qos = ClockQoS(), bool use_clock_thread = true);
  TimeSource(const TimeSource&) = delete;
  TimeSource& operator=(const TimeSource&) = delete;
  ~TimeSource();

  void attachNode(std::shared_ptr<Node> node);
  void detachNode();
  void attachClock(Clock::SharedPtr clock);
  void detachClock(Clock::SharedPtr clock);
  bool get_use_clock_thread();
  void set_use_clock_thread(bool use_clock_thread);
  bool clock_thread_is_joinable();

  class Impl;

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace rclcpp
