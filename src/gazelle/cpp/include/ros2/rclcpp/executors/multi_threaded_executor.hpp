#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>

#include "rclcpp/executor.hpp"

namespace rclcpp {
namespace executors {

/// Runs callbacks in several threads, as far as their groups allow.
class RCLCPP_PUBLIC MultiThreadedExecutor : public Executor {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(MultiThreadedExecutor)
  explicit MultiThreadedExecutor(const ExecutorOptions& options = ExecutorOptions(),
                                 std::size_t number_of_threads = 0,
                                 bool yield_before_execute = false,
                                 std::chrono::nanoseconds timeout = std::chrono::nanoseconds(-1));
  ~MultiThreadedExecutor() override = default;
  void spin() override;
  std::size_t get_number_of_threads() { return number_of_threads_; }

 private:
  void run();
  std::mutex wait_mutex_;
  std::size_t number_of_threads_;
  bool yield_before_execute_;
  std::chrono::nanoseconds timeout_;
};

}  // namespace executors
}  // namespace rclcpp
