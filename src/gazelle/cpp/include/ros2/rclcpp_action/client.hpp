#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "rclcpp/client.hpp"
#include "rclcpp/logging.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"
#include "rclcpp/subscription.hpp"
#include "rclcpp_action/client_goal_handle.hpp"
#include "rclcpp_action/types.hpp"
#include "rclcpp_action/visibility_control.hpp"

namespace rclcpp_action {

/// What action clients of all types share.
class RCLCPP_ACTION_PUBLIC ClientBase {
 public:
  virtual ~ClientBase() = default;
  virtual bool action_server_is_ready() const = 0;
  template <typename RepT = int64_t, typename RatioT = std::milli>
  bool wait_for_action_server(
      std::chrono::duration<RepT, RatioT> timeout = std::chrono::duration<RepT, RatioT>(-1)) {
    return wait_for_server(std::chrono::duration_cast<std::chrono::nanoseconds>(timeout));
  }

 protected:
  virtual bool wait_for_server(std::chrono::nanoseconds timeout) = 0;
  static GoalUUID new_id();
};

/// Sends goals of one action and hears how they go while an executor spins.
template <typename ActionT>
class Client : public ClientBase, public std::enable_shared_from_this<Client<ActionT>> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(Client)
  using Goal = typename ActionT::Goal;
  using Feedback = typename ActionT::Feedback;
  using GoalHandle = ClientGoalHandle<ActionT>;
  using WrappedResult = typename GoalHandle::WrappedResult;
  using FeedbackCallback = typename GoalHandle::FeedbackCallback;
  using ResultCallback = typename GoalHandle::ResultCallback;
  using CancelRequest = action_msgs::srv::CancelGoal::Request;
  using CancelResponse = action_msgs::srv::CancelGoal::Response;
  using CancelCallback = std::function<void(typename CancelResponse::SharedPtr)>;

  /// A function of the handle, or of a future of it as before Humble.
  class GoalResponseCallback {
   public:
    GoalResponseCallback() = default;
    GoalResponseCallback(std::nullptr_t) {}  // NOLINT(runtime/explicit)
    template <class F,
              std::enable_if_t<
                  !std::is_same_v<std::decay_t<F>, GoalResponseCallback> &&
                      (std::is_invocable_v<F&, typename GoalHandle::SharedPtr> ||
                       std::is_invocable_v<F&, std::shared_future<typename GoalHandle::SharedPtr>>),
                  int> = 0>
    GoalResponseCallback(F function) {  // NOLINT(runtime/explicit)
      if constexpr (std::is_invocable_v<F&, typename GoalHandle::SharedPtr>) {
        call_ = std::move(function);
      } else {
        call_ = [function](typename GoalHandle::SharedPtr handle) mutable {
          std::promise<typename GoalHandle::SharedPtr> promise;
          promise.set_value(handle);
          function(promise.get_future().share());
        };
      }
    }
    explicit operator bool() const { return static_cast<bool>(call_); }
    void operator()(typename GoalHandle::SharedPtr handle) const { call_(handle); }

   private:
    std::function<void(typename GoalHandle::SharedPtr)> call_;
  };

  struct SendGoalOptions {
    GoalResponseCallback goal_response_callback;
    FeedbackCallback feedback_callback;
    ResultCallback result_callback;
  };

  Client(rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base, const std::string& name,
         const rcl_action_client_options_t& options, rclcpp::CallbackGroup::SharedPtr group)
      : group_(group ? group : base->get_default_callback_group()), base_(base) {
    (void)options;
    const rclcpp::ServicesQoS qos;
    const std::string below = name + "/_action/";
    send_goal_ = std::make_shared<rclcpp::Client<SendGoal>>(base.get(), below + "send_goal", qos);
    get_result_ =
        std::make_shared<rclcpp::Client<GetResult>>(base.get(), below + "get_result", qos);
    cancel_ = std::make_shared<rclcpp::Client<CancelGoal>>(base.get(), below + "cancel_goal", qos);
    feedback_ = std::make_shared<rclcpp::Subscription<FeedbackMessage>>(
        base.get(), below + "feedback", rclcpp::QoS(10),
        [this](const std::shared_ptr<const FeedbackMessage> message) { on_feedback(message); },
        rclcpp::SubscriptionOptions());
    status_ = std::make_shared<rclcpp::Subscription<action_msgs::msg::GoalStatusArray>>(
        base.get(), below + "status", rclcpp::QoS(1).transient_local(),
        [this](const action_msgs::msg::GoalStatusArray& message) { on_status(message); },
        rclcpp::SubscriptionOptions());
    group_->add(send_goal_);
    group_->add(get_result_);
    group_->add(cancel_);
    group_->add(feedback_);
    group_->add(status_);
  }

  ~Client() override {
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& one : goals_) {
      if (const auto handle = one.second.lock()) {
        handle->invalidate(exceptions::UnawareGoalHandleError());
      }
    }
  }

  bool action_server_is_ready() const override {
    return send_goal_->service_is_ready() && get_result_->service_is_ready() &&
           cancel_->service_is_ready();
  }

  std::shared_future<typename GoalHandle::SharedPtr> async_send_goal(
      const Goal& goal, const SendGoalOptions& options = SendGoalOptions()) {
    auto promise = std::make_shared<std::promise<typename GoalHandle::SharedPtr>>();
    std::shared_future<typename GoalHandle::SharedPtr> future(promise->get_future());
    auto request = std::make_shared<typename SendGoal::Request>();
    const GoalUUID id = new_id();
    request->goal_id.uuid = id;
    request->goal = goal;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      for (auto one = goals_.begin(); one != goals_.end();) {
        one = one->second.expired() ? goals_.erase(one) : std::next(one);
      }
    }
    std::weak_ptr<Client> weak = this->shared_from_this();
    send_goal_->async_send_request(
        request,
        [weak, promise, options, id](typename rclcpp::Client<SendGoal>::SharedFuture answer) {
          const auto response = answer.get();
          if (!response->accepted) {
            promise->set_value(nullptr);
            if (options.goal_response_callback) options.goal_response_callback(nullptr);
            return;
          }
          GoalInfo info;
          info.goal_id.uuid = id;
          info.stamp = response->stamp;
          typename GoalHandle::SharedPtr handle(
              new GoalHandle(info, options.feedback_callback, options.result_callback));
          const auto self = weak.lock();
          if (self) {
            std::lock_guard<std::mutex> lock(self->mutex_);
            self->goals_[id] = handle;
          }
          promise->set_value(handle);
          if (options.goal_response_callback) options.goal_response_callback(handle);
          if (options.result_callback && self) self->ask_for_result(handle);
        });
    return future;
  }

  std::shared_future<WrappedResult> async_get_result(typename GoalHandle::SharedPtr handle,
                                                     ResultCallback callback = nullptr) {
    must_know(handle);
    if (callback) {
      std::lock_guard<std::mutex> lock(handle->mutex_);
      handle->result_callback_ = std::move(callback);
    }
    ask_for_result(handle);
    return handle->async_get_result();
  }

  std::shared_future<typename CancelResponse::SharedPtr> async_cancel_goal(
      typename GoalHandle::SharedPtr handle, CancelCallback callback = nullptr) {
    must_know(handle);
    auto request = std::make_shared<CancelRequest>();
    request->goal_info.goal_id.uuid = handle->get_goal_id();
    return send_cancel(request, std::move(callback));
  }
  std::shared_future<typename CancelResponse::SharedPtr> async_cancel_all_goals(
      CancelCallback callback = nullptr) {
    return send_cancel(std::make_shared<CancelRequest>(), std::move(callback));
  }
  std::shared_future<typename CancelResponse::SharedPtr> async_cancel_goals_before(
      const rclcpp::Time& stamp, CancelCallback callback = nullptr) {
    auto request = std::make_shared<CancelRequest>();
    request->goal_info.stamp = stamp;
    return send_cancel(request, std::move(callback));
  }
  void stop_callbacks(typename GoalHandle::SharedPtr handle) {
    std::lock_guard<std::mutex> lock(handle->mutex_);
    handle->feedback_callback_ = nullptr;
    handle->result_callback_ = nullptr;
  }

 private:
  using SendGoal = typename ActionT::Impl::SendGoalService;
  using GetResult = typename ActionT::Impl::GetResultService;
  using CancelGoal = action_msgs::srv::CancelGoal;
  using FeedbackMessage = typename ActionT::Impl::FeedbackMessage;

  bool wait_for_server(std::chrono::nanoseconds timeout) override {
    const auto end = std::chrono::steady_clock::now() + timeout;
    const std::shared_ptr<rclcpp::ClientBase> all[] = {send_goal_, get_result_, cancel_};
    for (const auto& one : all) {
      auto left = std::chrono::nanoseconds(-1);
      if (timeout >= std::chrono::nanoseconds(0)) {
        left = std::max(std::chrono::nanoseconds(0),
                        std::chrono::nanoseconds(end - std::chrono::steady_clock::now()));
      }
      if (!one->wait_for_service(left)) return false;
    }
    return true;
  }

  void must_know(const typename GoalHandle::SharedPtr& handle) {
    std::lock_guard<std::mutex> lock(mutex_);
    if (!handle || !goals_.count(handle->get_goal_id())) {
      throw exceptions::UnknownGoalHandleError();
    }
  }

  typename GoalHandle::SharedPtr known(const GoalUUID& id) {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = goals_.find(id);
    return found == goals_.end() ? nullptr : found->second.lock();
  }

  void ask_for_result(const typename GoalHandle::SharedPtr& handle) {
    if (handle->set_result_awareness(true)) return;
    auto request = std::make_shared<typename GetResult::Request>();
    request->goal_id.uuid = handle->get_goal_id();
    std::weak_ptr<Client> weak = this->shared_from_this();
    get_result_->async_send_request(
        request, [weak, handle](typename rclcpp::Client<GetResult>::SharedFuture answer) {
          const auto response = answer.get();
          WrappedResult wrapped;
          wrapped.goal_id = handle->get_goal_id();
          wrapped.code = static_cast<ResultCode>(response->status);
          wrapped.result = std::make_shared<typename ActionT::Result>(response->result);
          handle->set_result(wrapped);
          if (const auto self = weak.lock()) {
            std::lock_guard<std::mutex> lock(self->mutex_);
            self->goals_.erase(handle->get_goal_id());
          }
        });
  }

  std::shared_future<typename CancelResponse::SharedPtr> send_cancel(
      std::shared_ptr<CancelRequest> request, CancelCallback callback) {
    auto promise = std::make_shared<std::promise<typename CancelResponse::SharedPtr>>();
    std::shared_future<typename CancelResponse::SharedPtr> future(promise->get_future());
    cancel_->async_send_request(
        request, [promise, callback](typename rclcpp::Client<CancelGoal>::SharedFuture answer) {
          promise->set_value(answer.get());
          if (callback) callback(answer.get());
        });
    return future;
  }

  void on_feedback(const std::shared_ptr<const FeedbackMessage>& message) {
    const auto handle = known(message->goal_id.uuid);
    if (!handle) return;
    FeedbackCallback callback;
    {
      std::lock_guard<std::mutex> lock(handle->mutex_);
      callback = handle->feedback_callback_;
    }
    if (callback) callback(handle, std::shared_ptr<const Feedback>(message, &message->feedback));
  }

  void on_status(const action_msgs::msg::GoalStatusArray& message) {
    for (const auto& one : message.status_list) {
      if (const auto handle = known(one.goal_info.goal_id.uuid)) handle->set_status(one.status);
    }
  }

  rclcpp::CallbackGroup::SharedPtr group_;
  rclcpp::node_interfaces::NodeBaseInterface::SharedPtr base_;
  typename rclcpp::Client<SendGoal>::SharedPtr send_goal_;
  typename rclcpp::Client<GetResult>::SharedPtr get_result_;
  rclcpp::Client<CancelGoal>::SharedPtr cancel_;
  typename rclcpp::Subscription<FeedbackMessage>::SharedPtr feedback_;
  rclcpp::Subscription<action_msgs::msg::GoalStatusArray>::SharedPtr status_;
  std::mutex mutex_;
  std::map<GoalUUID, std::weak_ptr<GoalHandle>> goals_;
};

}  // namespace rclcpp_action
