// A buffer in another node, asked by an action; somebody else has to spin the node meanwhile.
#pragma once

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include "rclcpp_action/rclcpp_action.hpp"
#include "tf2/exceptions.h"
#include "tf2_msgs/action/lookup_transform.hpp"
#include "tf2_ros/buffer_interface.hpp"
#include "tf2_ros/visibility_control.h"

namespace tf2_ros {

class TF2_ROS_PUBLIC LookupTransformGoalException : public std::runtime_error {
 public:
  explicit LookupTransformGoalException(const std::string& message) : std::runtime_error(message) {}
};
class TF2_ROS_PUBLIC GoalRejectedException : public LookupTransformGoalException {
 public:
  using LookupTransformGoalException::LookupTransformGoalException;
};
class TF2_ROS_PUBLIC GoalAbortedException : public LookupTransformGoalException {
 public:
  using LookupTransformGoalException::LookupTransformGoalException;
};
class TF2_ROS_PUBLIC GoalCanceledException : public LookupTransformGoalException {
 public:
  using LookupTransformGoalException::LookupTransformGoalException;
};
class TF2_ROS_PUBLIC UnexpectedResultCodeException : public LookupTransformGoalException {
 public:
  using LookupTransformGoalException::LookupTransformGoalException;
};

class BufferClient : public BufferInterface {
 public:
  using LookupTransformAction = tf2_msgs::action::LookupTransform;

  template <typename NodePtr>
  BufferClient(NodePtr node, const std::string ns, const double& check_frequency = 10.0,
               const tf2::Duration& timeout_padding = tf2::durationFromSec(2.0))
      : timeout_padding_(timeout_padding) {
    static_cast<void>(check_frequency);  // results are waited for, not looked for
    client_ = rclcpp_action::create_client<LookupTransformAction>(node, ns);
  }

  TransformStamped lookupTransform(
      const std::string& target_frame, const std::string& source_frame, const tf2::TimePoint& time,
      const tf2::Duration timeout = tf2::Duration::zero()) const override {
    LookupTransformAction::Goal goal;
    goal.target_frame = target_frame;
    goal.source_frame = source_frame;
    goal.source_time = toMsg(time);
    goal.timeout = toMsg(timeout);
    goal.advanced = false;
    return ask(goal, timeout);
  }
  TransformStamped lookupTransform(
      const std::string& target_frame, const tf2::TimePoint& target_time,
      const std::string& source_frame, const tf2::TimePoint& source_time,
      const std::string& fixed_frame,
      const tf2::Duration timeout = tf2::Duration::zero()) const override {
    LookupTransformAction::Goal goal;
    goal.target_frame = target_frame;
    goal.source_frame = source_frame;
    goal.source_time = toMsg(source_time);
    goal.timeout = toMsg(timeout);
    goal.target_time = toMsg(target_time);
    goal.fixed_frame = fixed_frame;
    goal.advanced = true;
    return ask(goal, timeout);
  }
  bool canTransform(const std::string& target_frame, const std::string& source_frame,
                    const tf2::TimePoint& time, const tf2::Duration timeout = tf2::Duration::zero(),
                    std::string* errstr = nullptr) const override {
    return succeeds([&] { lookupTransform(target_frame, source_frame, time, timeout); }, errstr);
  }
  bool canTransform(const std::string& target_frame, const tf2::TimePoint& target_time,
                    const std::string& source_frame, const tf2::TimePoint& source_time,
                    const std::string& fixed_frame,
                    const tf2::Duration timeout = tf2::Duration::zero(),
                    std::string* errstr = nullptr) const override {
    return succeeds(
        [&] {
          lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame,
                          timeout);
        },
        errstr);
  }
  bool waitForServer(const tf2::Duration& timeout = tf2::Duration::zero()) {
    return client_->wait_for_action_server(timeout);
  }

 private:
  template <class Function>
  static bool succeeds(Function function, std::string* why) {
    try {
      function();
    } catch (const std::runtime_error& error) {
      if (why != nullptr) *why = error.what();
      return false;
    }
    return true;
  }
  TransformStamped ask(const LookupTransformAction::Goal& goal, tf2::Duration timeout) const {
    if (!client_->wait_for_action_server(std::chrono::seconds(5)))
      throw tf2::ConnectivityException("Failed find available action server");
    const auto wait = timeout + timeout_padding_;
    auto accepted = client_->async_send_goal(goal);
    if (accepted.wait_for(wait) != std::future_status::ready)
      throw tf2::TimeoutException(
          "Did not receive the goal response for the goal sent to the "
          "action server within the specified time");
    const auto handle = accepted.get();
    if (!handle) throw GoalRejectedException("Goal rejected by action server");
    auto coming = client_->async_get_result(handle);
    if (coming.wait_for(wait) != std::future_status::ready)
      throw tf2::TimeoutException(
          "Did not receive the result for the goal sent to the action "
          "server within the specified time");
    const auto wrapped = coming.get();
    switch (wrapped.code) {
      case rclcpp_action::ResultCode::SUCCEEDED:
        break;
      case rclcpp_action::ResultCode::ABORTED:
        throw GoalAbortedException("LookupTransform action was aborted");
      case rclcpp_action::ResultCode::CANCELED:
        throw GoalCanceledException("LookupTransform action was canceled");
      default:
        throw UnexpectedResultCodeException("Unexpected result code returned from server");
    }
    const std::string& text = wrapped.result->error.error_string;
    switch (static_cast<tf2::TF2Error>(wrapped.result->error.error)) {
      case tf2::TF2Error::TF2_NO_ERROR:
        return wrapped.result->transform;
      case tf2::TF2Error::TF2_LOOKUP_ERROR:
        throw tf2::LookupException(text);
      case tf2::TF2Error::TF2_CONNECTIVITY_ERROR:
        throw tf2::ConnectivityException(text);
      case tf2::TF2Error::TF2_EXTRAPOLATION_ERROR:
        throw tf2::ExtrapolationException(text);
      case tf2::TF2Error::TF2_INVALID_ARGUMENT_ERROR:
        throw tf2::InvalidArgumentException(text);
      case tf2::TF2Error::TF2_TIMEOUT_ERROR:
        throw tf2::TimeoutException(text);
      default:
        throw tf2::TransformException(text);
    }
  }

  rclcpp_action::Client<LookupTransformAction>::SharedPtr client_;
  tf2::Duration timeout_padding_;
};

}  // namespace tf2_ros
