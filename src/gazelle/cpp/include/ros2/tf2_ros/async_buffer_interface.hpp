// Transforms that come later.
#pragma once

#include <functional>
#include <future>
#include <string>
#include <utility>

#include "geometry_msgs/msg/transform_stamped.hpp"
#include "tf2/buffer_core.hpp"
#include "tf2/time.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

class TransformStampedFuture : public std::shared_future<geometry_msgs::msg::TransformStamped> {
  using Future = std::shared_future<geometry_msgs::msg::TransformStamped>;

 public:
  TransformStampedFuture() noexcept = default;
  explicit TransformStampedFuture(Future&& future) noexcept : Future(std::move(future)) {}
  void setHandle(const tf2::TransformableRequestHandle handle) { handle_ = handle; }
  tf2::TransformableRequestHandle getHandle() const { return handle_; }

 private:
  tf2::TransformableRequestHandle handle_ = 0;
};

using TransformReadyCallback = std::function<void(const TransformStampedFuture&)>;

class AsyncBufferInterface {
 public:
  virtual ~AsyncBufferInterface() = default;
  virtual TransformStampedFuture waitForTransform(const std::string& target_frame,
                                                  const std::string& source_frame,
                                                  const tf2::TimePoint& time,
                                                  const tf2::Duration& timeout,
                                                  TransformReadyCallback callback) = 0;
  virtual void cancel(const TransformStampedFuture& ts_future) = 0;
};

}  // namespace tf2_ros
