#pragma once

#include "rclcpp/executors/single_threaded_executor.hpp"

namespace rclcpp {
namespace experimental {
namespace executors {

class RCLCPP_PUBLIC EventsExecutor : public rclcpp::executors::SingleThreadedExecutor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(EventsExecutor)
  using rclcpp::executors::SingleThreadedExecutor::SingleThreadedExecutor;
};

}  // namespace executors
}  // namespace experimental
}  // namespace rclcpp
