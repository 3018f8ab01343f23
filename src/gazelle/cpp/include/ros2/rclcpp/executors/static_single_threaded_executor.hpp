#pragma once

#include "rclcpp/executors/single_threaded_executor.hpp"

namespace rclcpp {
namespace executors {

/// The same as the single-threaded one, which looks anew only when something changed anyway.
class RCLCPP_PUBLIC StaticSingleThreadedExecutor : public SingleThreadedExecutor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(StaticSingleThreadedExecutor)
  using SingleThreadedExecutor::SingleThreadedExecutor;
};

}  // namespace executors
}  // namespace rclcpp
