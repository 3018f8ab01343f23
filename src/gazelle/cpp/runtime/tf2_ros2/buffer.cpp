#include "tf2_ros/buffer.hpp"

#include <sstream>

#include "tf2_ros/create_timer_ros.hpp"

namespace tf2_ros {

namespace {

constexpr std::int64_t look_again_ns = 10000000;
// Timers beyond this would only be asked for to say "for ever".
constexpr tf2::Duration longest_wait = std::chrono::hours(24 * 365);

template <class Can>
bool wait_until(const tf2::BufferCore& buffer, rclcpp::Clock& clock, const tf2::Duration& timeout,
                std::string* why, Can can) {
  const auto start = clock.now();
  const rclcpp::Duration length(timeout);
  const rclcpp::Duration backwards = rclcpp::Duration::from_seconds(3.0);
  auto now = start;
  while (now - start < length && !can(nullptr) && start - now <= backwards && rclcpp::ok()) {
    buffer.gazelle_tree().wait_for_change(look_again_ns);
    now = clock.now();
  }
  const bool is_there = can(why);
  if (!is_there && why != nullptr && timeout > tf2::Duration::zero()) {
    std::ostringstream text;
    text << ". canTransform returned after " << (clock.now() - start).seconds() << " timeout was "
         << tf2::durationToSec(timeout) << ".";
    *why += text.str();
  }
  return is_there;
}

}  // namespace

struct Buffer::Wait {
  std::mutex lock;
  bool is_over = false;
  std::string target, source;
  tf2::TimePoint time;
  std::promise<TransformStamped> promise;
  TransformStampedFuture future{promise.get_future().share()};
  TransformReadyCallback callback;
  TimerHandle timer = 0;
};

void Buffer::begin() {
  if (!clock_) throw std::invalid_argument("clock must be a valid instance");
  rcl_jump_threshold_t threshold{};
  threshold.on_clock_change = true;
  threshold.min_forward.nanoseconds = 0;
  threshold.min_backward.nanoseconds = -1;
  const auto jumped = [this](const rcl_time_jump_t& jump) {
    const bool is_other_clock = jump.clock_change == RCL_ROS_TIME_ACTIVATED ||
                                jump.clock_change == RCL_ROS_TIME_DEACTIVATED;
    if (!is_other_clock && jump.delta.nanoseconds >= 0) return;
    if (jump.delta.nanoseconds < 0)
      RCLCPP_WARN(logger(), "Detected jump back in time. Clearing TF buffer.");
    clear();
  };
  jump_ = clock_->create_jump_callback(nullptr, jumped, threshold);
}

Buffer::~Buffer() { jump_.reset(); }

rclcpp::Logger Buffer::logger() const {
  return logging_ ? logging_->get_logger() : rclcpp::get_logger("tf2_buffer");
}

bool Buffer::has_thread(std::string* errstr) const {
  if (isUsingDedicatedThread()) return true;
  if (errstr != nullptr) *errstr = threading_error;
  RCLCPP_ERROR(logger(), "%s", threading_error);
  return false;
}

TransformStamped Buffer::lookupTransform(const std::string& target_frame,
                                         const std::string& source_frame,
                                         const tf2::TimePoint& time,
                                         const tf2::Duration timeout) const {
  canTransform(target_frame, source_frame, time, timeout);
  return lookupTransform(target_frame, source_frame, time);
}

TransformStamped Buffer::lookupTransform(const std::string& target_frame,
                                         const tf2::TimePoint& target_time,
                                         const std::string& source_frame,
                                         const tf2::TimePoint& source_time,
                                         const std::string& fixed_frame,
                                         const tf2::Duration timeout) const {
  canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, timeout);
  return lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame);
}

bool Buffer::canTransform(const std::string& target_frame, const std::string& source_frame,
                          const tf2::TimePoint& target_time, const tf2::Duration timeout,
                          std::string* errstr) const {
  if (timeout > tf2::Duration::zero() && !has_thread(errstr)) return false;
  return wait_until(*this, *clock_, timeout, errstr, [&](std::string* why) {
    return canTransform(target_frame, source_frame, target_time, why);
  });
}

bool Buffer::canTransform(const std::string& target_frame, const tf2::TimePoint& target_time,
                          const std::string& source_frame, const tf2::TimePoint& source_time,
                          const std::string& fixed_frame, const tf2::Duration timeout,
                          std::string* errstr) const {
  if (timeout > tf2::Duration::zero() && !has_thread(errstr)) return false;
  return wait_until(*this, *clock_, timeout, errstr, [&](std::string* why) {
    return canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, why);
  });
}

TransformStampedFuture Buffer::waitForTransform(const std::string& target_frame,
                                                const std::string& source_frame,
                                                const tf2::TimePoint& time,
                                                const tf2::Duration& timeout,
                                                TransformReadyCallback callback) {
  if (!timers_)
    throw CreateTimerInterfaceException("timer interface not set before call to waitForTransform");
  const auto wait = std::make_shared<Wait>();
  wait->target = target_frame;
  wait->source = source_frame;
  wait->time = time;
  wait->callback = std::move(callback);
  const auto answered = [this, wait](tf2::TransformableRequestHandle, const std::string&,
                                     const std::string&, tf2::TimePoint,
                                     tf2::TransformableResult result) {
    end_waiting(wait, result == tf2::TransformAvailable
                          ? ""
                          : "Failed to transform from " + wait->source + " to " + wait->target);
  };
  // Held, so that an answer at once finds its number.
  std::unique_lock<std::mutex> hold(waits_lock_);
  const auto handle = addTransformableRequest(answered, target_frame, source_frame, time);
  wait->future.setHandle(handle);
  const TransformStampedFuture future = wait->future;
  if (handle == 0 || handle == gazelle::FrameTree::never) {
    hold.unlock();
    end_waiting(wait, handle == 0
                          ? ""
                          : "Failed to transform from " + source_frame + " to " + target_frame);
    return future;
  }
  waits_[handle] = wait;
  if (timeout < longest_wait) {
    wait->timer = timers_->createTimer(clock_, timeout, [this, wait](const TimerHandle&) {
      end_waiting(wait,
                  "Timed out waiting for transform from " + wait->source + " to " + wait->target);
    });
  }
  return future;
}

void Buffer::end_waiting(const std::shared_ptr<Wait>& wait, const std::string& why) {
  {
    std::lock_guard<std::mutex> hold(wait->lock);
    if (wait->is_over) return;
    wait->is_over = true;
  }
  TimerHandle timer = 0;
  const auto handle = wait->future.getHandle();
  {
    std::lock_guard<std::mutex> hold(waits_lock_);
    waits_.erase(handle);
    timer = wait->timer;
  }
  cancelTransformableRequest(handle);
  if (timer != 0) timers_->remove(timer);
  if (why.empty()) {
    try {
      wait->promise.set_value(lookupTransform(wait->target, wait->source, wait->time));
    } catch (const tf2::TransformException&) {
      wait->promise.set_exception(std::current_exception());  // e.g. cleared in between
    }
  } else if (why.compare(0, 5, "Timed") == 0) {
    wait->promise.set_exception(std::make_exception_ptr(tf2::TimeoutException(why)));
  } else {
    wait->promise.set_exception(std::make_exception_ptr(tf2::LookupException(why)));
  }
  if (wait->callback) wait->callback(wait->future);
  wait->callback = nullptr;
}

void Buffer::cancel(const TransformStampedFuture& ts_future) {
  std::shared_ptr<Wait> wait;
  {
    std::lock_guard<std::mutex> hold(waits_lock_);
    const auto found = waits_.find(ts_future.getHandle());
    if (found == waits_.end()) return;
    wait = found->second;
    waits_.erase(found);
  }
  {
    std::lock_guard<std::mutex> hold(wait->lock);
    wait->is_over = true;
  }
  cancelTransformableRequest(ts_future.getHandle());
  if (wait->timer != 0) timers_->remove(wait->timer);
}

CreateTimerROS::CreateTimerROS(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr node_base,
                               rclcpp::node_interfaces::NodeTimersInterface::SharedPtr node_timers,
                               rclcpp::CallbackGroup::SharedPtr callback_group)
    : node_base_(std::move(node_base)),
      node_timers_(std::move(node_timers)),
      callback_group_(std::move(callback_group)) {}

TimerHandle CreateTimerROS::createTimer(rclcpp::Clock::SharedPtr clock, const tf2::Duration& period,
                                        TimerCallbackType callback) {
  std::lock_guard<std::mutex> hold(lock_);
  const TimerHandle handle = ++last_;
  const auto once = [this, handle, callback] {
    cancel(handle);
    callback(handle);
  };
  timers_[handle] = rclcpp::create_timer(node_base_, node_timers_, clock, rclcpp::Duration(period),
                                         once, callback_group_);
  return handle;
}

rclcpp::TimerBase::SharedPtr CreateTimerROS::timer_of(const TimerHandle& timer_handle) {
  std::lock_guard<std::mutex> hold(lock_);
  const auto found = timers_.find(timer_handle);
  if (found == timers_.end())
    throw InvalidTimerHandleException("Invalid timer handle: " + std::to_string(timer_handle));
  return found->second;
}

void CreateTimerROS::cancel(const TimerHandle& timer_handle) { timer_of(timer_handle)->cancel(); }

void CreateTimerROS::reset(const TimerHandle& timer_handle) { timer_of(timer_handle)->reset(); }

void CreateTimerROS::remove(const TimerHandle& timer_handle) {
  const auto timer = timer_of(timer_handle);
  timer->cancel();
  std::lock_guard<std::mutex> hold(lock_);
  timers_.erase(timer_handle);
}

}  // namespace tf2_ros
