#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp_action/types.hpp"
#include "rclcpp_action/visibility_control.hpp"

namespace rclcpp_action {

class ServerBase;

/// One goal at the server, without its type.
class RCLCPP_ACTION_PUBLIC ServerGoalHandleBase {
 public:
  bool is_canceling() const;
  bool is_active() const;
  bool is_executing() const;
  virtual ~ServerGoalHandleBase();

 protected:
  ServerGoalHandleBase(std::shared_ptr<ServerBase> server, const GoalUUID& id)
      : server_(server), id_(id) {}
  void execute_state();
  void end_state(int8_t event, std::shared_ptr<void> result);
  /// Tell whether the goal had not ended and is cancelled by this.
  bool try_canceling() noexcept;
  std::weak_ptr<ServerBase> server_;
  const GoalUUID id_;
};

/// One goal at the server.
template <typename ActionT>
class ServerGoalHandle : public ServerGoalHandleBase {
 public:
  using Result = typename ActionT::Result;
  using Response = typename ActionT::Impl::GetResultService::Response;

  ServerGoalHandle(
      std::shared_ptr<ServerBase> server, const GoalUUID& id,
      std::shared_ptr<const typename ActionT::Goal> goal,
      std::function<void(std::shared_ptr<typename ActionT::Impl::FeedbackMessage>)> tell)
      : ServerGoalHandleBase(server, id), goal_(std::move(goal)), tell_(std::move(tell)) {}
  ~ServerGoalHandle() override {
    // Who lets go of a goal that has not ended cancels it.
    if (try_canceling()) end_with(5, std::make_shared<Result>());
  }

  void publish_feedback(std::shared_ptr<typename ActionT::Feedback> feedback) {
    auto message = std::make_shared<typename ActionT::Impl::FeedbackMessage>();
    message->goal_id.uuid = id_;
    message->feedback = *feedback;
    tell_(message);
  }
  void abort(typename Result::SharedPtr result) { end_with(6, result); }
  void succeed(typename Result::SharedPtr result) { end_with(4, result); }
  void canceled(typename Result::SharedPtr result) { end_with(5, result); }
  void execute() { execute_state(); }
  const std::shared_ptr<const typename ActionT::Goal> get_goal() const { return goal_; }
  const GoalUUID& get_goal_id() const { return id_; }

 private:
  void end_with(int8_t status, const std::shared_ptr<Result>& result) {
    auto response = std::make_shared<Response>();
    response->status = status;
    response->result = *result;
    end_state(status, response);
  }
  const std::shared_ptr<const typename ActionT::Goal> goal_;
  std::function<void(std::shared_ptr<typename ActionT::Impl::FeedbackMessage>)> tell_;
};

}  // namespace rclcpp_action
