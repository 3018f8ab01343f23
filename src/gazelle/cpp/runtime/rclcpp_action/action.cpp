// Actions: the states of goals at a server, and numbers of goals at a client.
#include <algorithm>
#include <cstdio>
#include <random>
#include <utility>

#include "gazelle/core.hpp"
#include "rclcpp_action/client.hpp"
#include "rclcpp_action/server.hpp"

namespace rclcpp_action {
namespace {

constexpr int8_t kAccepted = 1, kExecuting = 2, kCanceling = 3, kSucceeded = 4, kCanceled = 5,
                 kAborted = 6;

bool is_over(int8_t status) { return status >= kSucceeded; }

bool may_become(int8_t from, int8_t to) {
  switch (to) {
    case kExecuting:
      return from == kAccepted;
    case kCanceling:
      return from == kAccepted || from == kExecuting;
    case kSucceeded:
    case kAborted:
      return from == kExecuting || from == kCanceling;
    case kCanceled:
      return from == kCanceling;
    default:
      return false;
  }
}

[[noreturn]] void refuse(int8_t from, int8_t to) {
  static const char* const kWords[] = {"unknown",   "accepted", "executing", "canceling",
                                       "succeeded", "canceled", "aborted"};
  throw rclcpp::exceptions::RCLError(
      RCL_RET_ACTION_GOAL_EVENT_INVALID,
      std::string("goal_handle attempted invalid transition from state ") + kWords[from] + " to " +
          kWords[to]);
}

}  // namespace

std::string to_string(const GoalUUID& goal_id) {
  std::string text;
  for (std::size_t i = 0; i < goal_id.size(); ++i) {
    char digits[4];
    std::snprintf(digits, sizeof(digits), "%02x", goal_id[i]);
    if (i == 4 || i == 6 || i == 8 || i == 10) text += "-";
    text += digits;
  }
  return text;
}

GoalUUID ClientBase::new_id() {
  static std::mutex mutex;
  static std::mt19937_64 numbers{std::random_device{}()};
  GoalUUID id;
  std::lock_guard<std::mutex> lock(mutex);
  for (auto& byte : id) byte = static_cast<uint8_t>(numbers());
  return id;
}

// ---- The server ---------------------------------------------------------------------------------

ServerBase::ServerBase(Base base, rclcpp::Clock::SharedPtr clock, const std::string& name,
                       const rcl_action_server_options_t& options,
                       rclcpp::CallbackGroup::SharedPtr group)
    : base_(std::move(base)),
      clock_(std::move(clock)),
      name_(name),
      options_(options),
      group_(group ? group : base_->get_default_callback_group()) {}

ServerBase::~ServerBase() = default;

void ServerBase::add(const std::shared_ptr<rclcpp::detail::Executable>& executable) {
  group_->add(executable);
}

void ServerBase::start() {
  status_ = std::make_shared<rclcpp::Publisher<action_msgs::msg::GoalStatusArray>>(
      base_.get(), below("status"), rclcpp::QoS(1).transient_local(), rclcpp::PublisherOptions());
  cancel_ = std::make_shared<rclcpp::Service<CancelGoal>>(
      base_.get(), below("cancel_goal"),
      [this](const std::shared_ptr<CancelGoal::Request> request,
             std::shared_ptr<CancelGoal::Response> response) { on_cancel(*request, *response); },
      rclcpp::ServicesQoS());
  add(cancel_);
}

bool ServerBase::knows(const GoalUUID& id) {
  std::lock_guard<std::mutex> lock(mutex_);
  return goals_.count(id) > 0;
}

builtin_interfaces::msg::Time ServerBase::accept(const GoalUUID& id) {
  const rclcpp::Time now = clock_->now();
  std::lock_guard<std::mutex> lock(mutex_);
  forget_old();
  goals_[id] = GoalState{kAccepted, now, 0, nullptr, {}};
  return now;
}

void ServerBase::execute(const GoalUUID& id) {
  std::lock_guard<std::mutex> lock(mutex_);
  auto& goal = goals_.at(id);
  if (!may_become(goal.status, kExecuting)) refuse(goal.status, kExecuting);
  goal.status = kExecuting;
}

void ServerBase::end(const GoalUUID& id, int8_t status, std::shared_ptr<void> result) {
  std::vector<std::function<void(const void*)>> waiting;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    auto& goal = goals_.at(id);
    if (!may_become(goal.status, status)) refuse(goal.status, status);
    goal.status = status;
    goal.result = result;
    goal.ended_ns = gazelle::clock::steady_ns();
    waiting.swap(goal.waiting);
  }
  for (const auto& give : waiting) give(result.get());
  publish_status();
}

int8_t ServerBase::status_of(const GoalUUID& id) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = goals_.find(id);
  return found == goals_.end() ? 0 : found->second.status;
}

bool ServerBase::cancel(const GoalUUID& id) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = goals_.find(id);
  if (found == goals_.end() || !may_become(found->second.status, kCanceling)) return false;
  found->second.status = kCanceling;
  return true;
}

void ServerBase::publish_status() {
  action_msgs::msg::GoalStatusArray message;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& one : goals_) {
      action_msgs::msg::GoalStatus status;
      status.goal_info.goal_id.uuid = one.first;
      status.goal_info.stamp = one.second.accepted;
      status.status = one.second.status;
      message.status_list.push_back(status);
    }
  }
  status_->publish(message);
}

void ServerBase::wait_for_result(const GoalUUID& id, std::function<void(const void*)> give) {
  std::shared_ptr<void> result;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto found = goals_.find(id);
    if (found != goals_.end() && !found->second.result) {
      found->second.waiting.push_back(std::move(give));
      return;
    }
    if (found != goals_.end()) result = found->second.result;
  }
  give(result.get());
}

void ServerBase::forget_old() {
  const int64_t now = gazelle::clock::steady_ns();
  const int64_t keep = options_.result_timeout.nanoseconds;
  for (auto one = goals_.begin(); one != goals_.end();) {
    const auto& goal = one->second;
    const bool old = is_over(goal.status) && keep >= 0 && now - goal.ended_ns > keep;
    one = old ? goals_.erase(one) : std::next(one);
  }
}

void ServerBase::on_cancel(const CancelGoal::Request& request, CancelGoal::Response& response) {
  const GoalUUID none{};
  const GoalUUID& wanted = request.goal_info.goal_id.uuid;
  const rclcpp::Time stamp(request.goal_info.stamp);
  const bool every = wanted == none && stamp.nanoseconds() == 0;
  std::vector<std::pair<GoalUUID, rclcpp::Time>> goals;
  bool known = false;
  bool over = false;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& one : goals_) {
      const bool named = one.first == wanted;
      const bool early =
          stamp.nanoseconds() > 0 && one.second.accepted.nanoseconds() <= stamp.nanoseconds();
      known = known || named;
      if (named && is_over(one.second.status)) over = true;
      if ((every || named || early) && may_become(one.second.status, kCanceling)) {
        goals.emplace_back(one.first, one.second.accepted);
      }
    }
  }
  response.return_code = CancelGoal::Response::ERROR_NONE;
  if (wanted != none && stamp.nanoseconds() == 0) {
    if (!known) response.return_code = CancelGoal::Response::ERROR_UNKNOWN_GOAL_ID;
    if (over) response.return_code = CancelGoal::Response::ERROR_GOAL_TERMINATED;
  }
  for (const auto& one : goals) {
    if (call_handle_cancel(one.first) != CancelResponse::ACCEPT || !cancel(one.first)) continue;
    action_msgs::msg::GoalInfo info;
    info.goal_id.uuid = one.first;
    info.stamp = one.second;
    response.goals_canceling.push_back(info);
  }
  if (!goals.empty() && response.goals_canceling.empty()) {
    response.return_code = CancelGoal::Response::ERROR_REJECTED;
  }
  if (!response.goals_canceling.empty()) publish_status();
}

// ---- Goals at the server ------------------------------------------------------------------------

ServerGoalHandleBase::~ServerGoalHandleBase() = default;

bool ServerGoalHandleBase::is_canceling() const {
  const auto server = server_.lock();
  return server && server->status_of(id_) == kCanceling;
}

bool ServerGoalHandleBase::is_active() const {
  const auto server = server_.lock();
  const int8_t status = server ? server->status_of(id_) : 0;
  return status > 0 && !is_over(status);
}

bool ServerGoalHandleBase::is_executing() const {
  const auto server = server_.lock();
  return server && server->status_of(id_) == kExecuting;
}

void ServerGoalHandleBase::execute_state() {
  const auto server = server_.lock();
  if (!server) return;
  server->execute(id_);
  server->publish_status();
}

void ServerGoalHandleBase::end_state(int8_t event, std::shared_ptr<void> result) {
  if (const auto server = server_.lock()) server->end(id_, event, std::move(result));
}

bool ServerGoalHandleBase::try_canceling() noexcept {
  const auto server = server_.lock();
  if (!server) return false;
  const int8_t status = server->status_of(id_);
  if (status == 0 || is_over(status)) return false;
  return status == kCanceling || server->cancel(id_);
}

}  // namespace rclcpp_action
