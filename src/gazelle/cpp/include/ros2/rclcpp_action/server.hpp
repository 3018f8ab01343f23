#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_clock_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"
#include "rclcpp/publisher.hpp"
#include "rclcpp/service.hpp"
#include "rclcpp_action/server_goal_handle.hpp"
#include "rclcpp_action/types.hpp"
#include "rclcpp_action/visibility_control.hpp"

namespace rclcpp_action {

enum class GoalResponse : int8_t { REJECT = 1, ACCEPT_AND_EXECUTE = 2, ACCEPT_AND_DEFER = 3 };
enum class CancelResponse : int8_t { REJECT = 1, ACCEPT = 2 };

/// The states of all goals, cancelling, status and results; the types are the derived class's.
class RCLCPP_ACTION_PUBLIC ServerBase : public std::enable_shared_from_this<ServerBase> {
 public:
  virtual ~ServerBase();

 protected:
  friend class ServerGoalHandleBase;
  using Base = std::shared_ptr<rclcpp::node_interfaces::NodeBaseInterface>;
  using CancelGoal = action_msgs::srv::CancelGoal;
  ServerBase(Base base, rclcpp::Clock::SharedPtr clock, const std::string& name,
             const rcl_action_server_options_t& options, rclcpp::CallbackGroup::SharedPtr group);

  /// Offer what has no types; called once the derived class is whole.
  void start();
  /// Add something to the group in which the server's callbacks run.
  void add(const std::shared_ptr<rclcpp::detail::Executable>& executable);
  std::string below(const char* part) const { return name_ + "/_action/" + part; }
  rclcpp::node_interfaces::NodeBaseInterface* base() const { return base_.get(); }

  bool knows(const GoalUUID& id);
  builtin_interfaces::msg::Time accept(const GoalUUID& id);
  void execute(const GoalUUID& id);
  void end(const GoalUUID& id, int8_t status, std::shared_ptr<void> result);
  int8_t status_of(const GoalUUID& id);
  bool cancel(const GoalUUID& id);
  void publish_status();
  /// Give a result to who asks, now or when there is one.
  void wait_for_result(const GoalUUID& id, std::function<void(const void*)> give);

  virtual CancelResponse call_handle_cancel(const GoalUUID& id) = 0;

 private:
  struct GoalState {
    int8_t status;
    rclcpp::Time accepted;
    int64_t ended_ns = 0;
    std::shared_ptr<void> result;
    std::vector<std::function<void(const void*)>> waiting;
  };
  void on_cancel(const CancelGoal::Request& request, CancelGoal::Response& response);
  void forget_old();

  Base base_;
  rclcpp::Clock::SharedPtr clock_;
  std::string name_;
  rcl_action_server_options_t options_;
  rclcpp::CallbackGroup::SharedPtr group_;
  std::mutex mutex_;
  std::map<GoalUUID, GoalState> goals_;
  rclcpp::Service<CancelGoal>::SharedPtr cancel_;
  rclcpp::Publisher<action_msgs::msg::GoalStatusArray>::SharedPtr status_;
};

/// Takes goals of one action, tells how they go, and gives their results.
template <typename ActionT>
class Server : public ServerBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Server)
  using GoalHandle = ServerGoalHandle<ActionT>;
  using GoalCallback =
      std::function<GoalResponse(const GoalUUID&, std::shared_ptr<const typename ActionT::Goal>)>;
  using CancelCallback = std::function<CancelResponse(std::shared_ptr<GoalHandle>)>;
  using AcceptedCallback = std::function<void(std::shared_ptr<GoalHandle>)>;
  using SendGoal = typename ActionT::Impl::SendGoalService;
  using GetResult = typename ActionT::Impl::GetResultService;
  using FeedbackMessage = typename ActionT::Impl::FeedbackMessage;

  Server(Base base, rclcpp::Clock::SharedPtr clock, const std::string& name,
         const rcl_action_server_options_t& options, GoalCallback handle_goal,
         CancelCallback handle_cancel, AcceptedCallback handle_accepted,
         rclcpp::CallbackGroup::SharedPtr group)
      : ServerBase(base, clock, name, options, group),
        handle_goal_(std::move(handle_goal)),
        handle_cancel_(std::move(handle_cancel)),
        handle_accepted_(std::move(handle_accepted)) {}

  void open() {
    const rclcpp::ServicesQoS qos;
    feedback_ = std::make_shared<rclcpp::Publisher<FeedbackMessage>>(
        base(), below("feedback"), rclcpp::QoS(10), rclcpp::PublisherOptions());
    start();
    send_goal_ = std::make_shared<rclcpp::Service<SendGoal>>(
        base(), below("send_goal"),
        [this](const std::shared_ptr<typename SendGoal::Request> request,
               std::shared_ptr<typename SendGoal::Response> response) {
          on_goal(request, *response);
        },
        qos);
    get_result_ = std::make_shared<rclcpp::Service<GetResult>>(
        base(), below("get_result"),
        [this](std::shared_ptr<rmw_request_id_t> header,
               std::shared_ptr<typename GetResult::Request> request) {
          on_result(header, request->goal_id.uuid);
        },
        qos);
    add(send_goal_);
    add(get_result_);
  }

 private:
  using Weak = std::weak_ptr<GoalHandle>;

  void on_goal(const std::shared_ptr<typename SendGoal::Request>& request,
               typename SendGoal::Response& response) {
    const GoalUUID id = request->goal_id.uuid;
    response.accepted = false;
    if (knows(id)) return;
    const std::shared_ptr<const typename ActionT::Goal> goal(request, &request->goal);
    const GoalResponse answer = handle_goal_(id, goal);
    if (answer == GoalResponse::REJECT) return;
    response.accepted = true;
    response.stamp = accept(id);
    std::weak_ptr<rclcpp::Publisher<FeedbackMessage>> feedback = feedback_;
    auto handle = std::make_shared<GoalHandle>(
        shared_from_this(), id, goal, [feedback](std::shared_ptr<FeedbackMessage> message) {
          if (const auto publisher = feedback.lock()) publisher->publish(*message);
        });
    {
      std::lock_guard<std::mutex> lock(handles_mutex_);
      for (auto one = handles_.begin(); one != handles_.end();) {
        one = one->second.expired() ? handles_.erase(one) : std::next(one);
      }
      handles_[id] = handle;
    }
    if (answer == GoalResponse::ACCEPT_AND_EXECUTE) execute(id);
    publish_status();
    handle_accepted_(handle);
  }

  void on_result(const std::shared_ptr<rmw_request_id_t>& header, const GoalUUID& id) {
    std::weak_ptr<rclcpp::Service<GetResult>> service = get_result_;
    wait_for_result(id, [service, header](const void* result) {
      const auto strong = service.lock();
      if (!strong) return;
      typename GetResult::Response response;
      // Who asks for a goal that is not known learns so by its status.
      if (result) response = *static_cast<const typename GetResult::Response*>(result);
      strong->send_response(*header, response);
    });
  }

  CancelResponse call_handle_cancel(const GoalUUID& id) override {
    std::shared_ptr<GoalHandle> handle;
    {
      std::lock_guard<std::mutex> lock(handles_mutex_);
      const auto found = handles_.find(id);
      if (found != handles_.end()) handle = found->second.lock();
    }
    if (!handle) return CancelResponse::REJECT;
    return handle_cancel_(handle);
  }

  GoalCallback handle_goal_;
  CancelCallback handle_cancel_;
  AcceptedCallback handle_accepted_;
  typename rclcpp::Publisher<FeedbackMessage>::SharedPtr feedback_;
  typename rclcpp::Service<SendGoal>::SharedPtr send_goal_;
  typename rclcpp::Service<GetResult>::SharedPtr get_result_;
  std::mutex handles_mutex_;
  std::map<GoalUUID, Weak> handles_;
};

}  // namespace rclcpp_action
