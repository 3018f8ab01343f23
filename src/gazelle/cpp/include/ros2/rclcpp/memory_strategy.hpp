#pragma once

#include "rclcpp/macros.hpp"

namespace rclcpp {
namespace memory_strategy {

/// How an executor keeps what it waits for; executors here keep it in one way.
class MemoryStrategy {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(MemoryStrategy)
  virtual ~MemoryStrategy() = default;
};

}  // namespace memory_strategy
}  // namespace rclcpp
