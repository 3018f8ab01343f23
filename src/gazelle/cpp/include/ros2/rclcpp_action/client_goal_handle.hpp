#pragma once

#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <utility>

#include "rclcpp/macros.hpp"
#include "rclcpp/time.hpp"
#include "rclcpp_action/exceptions.hpp"
#include "rclcpp_action/types.hpp"

namespace rclcpp_action {

template <typename ActionT>
class Client;

/// One goal at the client.
template <typename ActionT>
class ClientGoalHandle {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(ClientGoalHandle)
  using Feedback = typename ActionT::Feedback;
  using Result = typename ActionT::Result;

  /// How a goal ended and what came of it.
  struct WrappedResult {
    GoalUUID goal_id;
    ResultCode code;
    typename Result::SharedPtr result;
  };
  using FeedbackCallback = std::function<void(typename ClientGoalHandle<ActionT>::SharedPtr,
                                              const std::shared_ptr<const Feedback>)>;
  using ResultCallback = std::function<void(const WrappedResult&)>;

  virtual ~ClientGoalHandle() = default;
  const GoalUUID& get_goal_id() const { return info_.goal_id.uuid; }
  rclcpp::Time get_goal_stamp() const { return info_.stamp; }
  std::shared_future<WrappedResult> async_get_result() {
    std::lock_guard<std::mutex> lock(mutex_);
    if (!aware_of_result_) throw exceptions::UnawareGoalHandleError();
    return future_;
  }
  int8_t get_status() {
    std::lock_guard<std::mutex> lock(mutex_);
    return status_;
  }
  bool is_feedback_aware() {
    std::lock_guard<std::mutex> lock(mutex_);
    return feedback_callback_ != nullptr;
  }
  bool is_result_aware() {
    std::lock_guard<std::mutex> lock(mutex_);
    return aware_of_result_;
  }

 private:
  friend class Client<ActionT>;
  ClientGoalHandle(const GoalInfo& info, FeedbackCallback feedback, ResultCallback result)
      : info_(info),
        feedback_callback_(std::move(feedback)),
        result_callback_(std::move(result)),
        future_(promise_.get_future()) {}

  bool set_result_awareness(bool aware) {
    std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(aware_of_result_, aware);
  }
  void set_status(int8_t status) {
    std::lock_guard<std::mutex> lock(mutex_);
    status_ = status;
  }
  void set_result(const WrappedResult& result) {
    ResultCallback callback;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      if (done_) return;
      done_ = true;
      status_ = static_cast<int8_t>(result.code);
      promise_.set_value(result);
      callback = std::exchange(result_callback_, nullptr);
    }
    if (callback) callback(result);
  }
  void invalidate(const exceptions::UnawareGoalHandleError& error) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (done_) return;
    done_ = true;
    promise_.set_exception(std::make_exception_ptr(error));
  }

  GoalInfo info_;
  std::mutex mutex_;
  FeedbackCallback feedback_callback_;
  ResultCallback result_callback_;
  bool aware_of_result_ = false;
  bool done_ = false;
  int8_t status_ = GoalStatus::STATUS_ACCEPTED;
  std::promise<WrappedResult> promise_;
  std::shared_future<WrappedResult> future_;
};

}  // namespace rclcpp_action
