// What a clock is inside.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "rclcpp/clock.hpp"

namespace rclcpp {

class Clock::Impl : public std::enable_shared_from_this<Clock::Impl> {
 public:
  explicit Impl(rcl_clock_type_t type);
  ~Impl();
  std::int64_t now_ns() const;
  /// Follow simulated time, or the wall's again.
  void use_sim_time(bool use);
  bool is_simulated() const { return type == RCL_ROS_TIME && sim.load(); }
  bool wait(std::int64_t until_ns, const std::function<bool()>& stop);
  void tell_jump(const rcl_time_jump_t& jump);

  const rcl_clock_type_t type;
  rcl_clock_t handle{};
  std::mutex mutex;
  std::atomic<bool> sim{false};
  std::atomic<std::uint64_t> cancelled{0};
  std::mutex handlers_mutex;
  std::vector<std::weak_ptr<JumpHandler>> handlers;

 private:
  std::uint64_t jump_listener_ = 0;
};

}  // namespace rclcpp
