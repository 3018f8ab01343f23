#pragma once

#include "rclcpp/executor.hpp"

namespace rclcpp {
namespace executors {

/// Runs all callbacks in the thread that spins.
class RCLCPP_PUBLIC SingleThreadedExecutor : public Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(SingleThreadedExecutor)
  explicit SingleThreadedExecutor(const ExecutorOptions& options = ExecutorOptions())
      : Executor(options) {}
  ~SingleThreadedExecutor() override = default;
  void spin() override;
};

}  // namespace executors
}  // namespace rclcpp
