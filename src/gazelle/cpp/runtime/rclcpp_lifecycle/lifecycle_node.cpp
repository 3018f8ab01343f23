// Managed nodes: their states, and the services by which others change them.
#include "rclcpp_lifecycle/lifecycle_node.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "lifecycle_msgs/msg/transition_event.hpp"
#include "lifecycle_msgs/srv/change_state.hpp"
#include "lifecycle_msgs/srv/get_available_states.hpp"
#include "lifecycle_msgs/srv/get_available_transitions.hpp"
#include "lifecycle_msgs/srv/get_state.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp_lifecycle {
namespace {

using CallbackReturn = LifecycleNode::CallbackReturn;
using lifecycle_msgs::msg::TransitionDescription;
namespace srv = lifecycle_msgs::srv;

constexpr uint8_t kUnconfigured = 1, kInactive = 2, kActive = 3, kFinalized = 4;
constexpr uint8_t kConfiguring = 10, kCleaningUp = 11, kShuttingDown = 12, kActivating = 13,
                  kDeactivating = 14, kErrorProcessing = 15;

struct StateRow {
  uint8_t id;
  const char* label;
};
constexpr StateRow kStates[] = {
    {0, "unknown"},
    {kUnconfigured, "unconfigured"},
    {kInactive, "inactive"},
    {kActive, "active"},
    {kFinalized, "finalized"},
    {kConfiguring, "configuring"},
    {kCleaningUp, "cleaningup"},
    {kShuttingDown, "shuttingdown"},
    {kActivating, "activating"},
    {kDeactivating, "deactivating"},
    {kErrorProcessing, "errorprocessing"},
};

struct TransitionRow {
  uint8_t id;
  const char* label;
  uint8_t start, goal;
};
constexpr const char* kSuccess = "transition_success";
constexpr const char* kFailure = "transition_failure";
constexpr const char* kError = "transition_error";
constexpr TransitionRow kTransitions[] = {
    {1, "configure", kUnconfigured, kConfiguring},   {10, kSuccess, kConfiguring, kInactive},
    {11, kFailure, kConfiguring, kUnconfigured},     {12, kError, kConfiguring, kErrorProcessing},
    {2, "cleanup", kInactive, kCleaningUp},          {20, kSuccess, kCleaningUp, kUnconfigured},
    {21, kFailure, kCleaningUp, kInactive},          {22, kError, kCleaningUp, kErrorProcessing},
    {3, "activate", kInactive, kActivating},         {30, kSuccess, kActivating, kActive},
    {31, kFailure, kActivating, kInactive},          {32, kError, kActivating, kErrorProcessing},
    {4, "deactivate", kActive, kDeactivating},       {40, kSuccess, kDeactivating, kInactive},
    {41, kFailure, kDeactivating, kActive},          {42, kError, kDeactivating, kErrorProcessing},
    {5, "shutdown", kUnconfigured, kShuttingDown},   {6, "shutdown", kInactive, kShuttingDown},
    {7, "shutdown", kActive, kShuttingDown},         {50, kSuccess, kShuttingDown, kFinalized},
    {51, kFailure, kShuttingDown, kFinalized},       {52, kError, kShuttingDown, kErrorProcessing},
    {60, kSuccess, kErrorProcessing, kUnconfigured}, {61, kFailure, kErrorProcessing, kFinalized},
    {62, kError, kErrorProcessing, kFinalized},
};

const char* label_of(uint8_t state) {
  for (const auto& one : kStates) {
    if (one.id == state) return one.label;
  }
  return "unknown";
}

const char* label_of(CallbackReturn code) {
  switch (code) {
    case CallbackReturn::SUCCESS:
      return kSuccess;
    case CallbackReturn::FAILURE:
      return kFailure;
    default:
      return kError;
  }
}

Transition made_of(const TransitionRow& row) {
  return Transition(row.id, row.label, State(row.start, label_of(row.start)),
                    State(row.goal, label_of(row.goal)));
}

TransitionDescription described(const TransitionRow& row) {
  TransitionDescription text;
  text.transition.id = row.id;
  text.transition.label = row.label;
  text.start_state.id = row.start;
  text.start_state.label = label_of(row.start);
  text.goal_state.id = row.goal;
  text.goal_state.label = label_of(row.goal);
  return text;
}

}  // namespace

class LifecycleNode::Impl {
 public:
  explicit Impl(LifecycleNode* node) : node_(node), state_(kUnconfigured, "unconfigured") {}

  void offer() {
    const auto base = node_->get_node_base_interface();
    const auto services = node_->get_node_services_interface();
    const std::string prefix = "~/";
    events_ = rclcpp::create_publisher<lifecycle_msgs::msg::TransitionEvent>(
        node_->get_node_topics_interface(), prefix + "transition_event", rclcpp::QoS(1).reliable());
    add(rclcpp::create_service<srv::ChangeState>(
        base, services, prefix + "change_state",
        [this](const std::shared_ptr<srv::ChangeState::Request> request,
               std::shared_ptr<srv::ChangeState::Response> response) {
          std::uint8_t id = request->transition.id;
          if (id == 0 && !request->transition.label.empty()) {
            const auto* row = found(0, request->transition.label);
            if (!row) {
              response->success = false;
              return;
            }
            id = row->id;
          }
          CallbackReturn code = CallbackReturn::ERROR;
          response->success = change(id, code) && code == CallbackReturn::SUCCESS;
        },
        rclcpp::ServicesQoS(), nullptr));
    add(rclcpp::create_service<srv::GetState>(
        base, services, prefix + "get_state",
        [this](const std::shared_ptr<srv::GetState::Request>,
               std::shared_ptr<srv::GetState::Response> response) {
          std::lock_guard<std::recursive_mutex> lock(mutex_);
          response->current_state.id = state_.id();
          response->current_state.label = state_.label();
        },
        rclcpp::ServicesQoS(), nullptr));
    add(rclcpp::create_service<srv::GetAvailableStates>(
        base, services, prefix + "get_available_states",
        [](const std::shared_ptr<srv::GetAvailableStates::Request>,
           std::shared_ptr<srv::GetAvailableStates::Response> response) {
          for (const auto& one : kStates) {
            lifecycle_msgs::msg::State state;
            state.id = one.id;
            state.label = one.label;
            response->available_states.push_back(state);
          }
        },
        rclcpp::ServicesQoS(), nullptr));
    add(rclcpp::create_service<srv::GetAvailableTransitions>(
        base, services, prefix + "get_available_transitions",
        [this](const std::shared_ptr<srv::GetAvailableTransitions::Request>,
               std::shared_ptr<srv::GetAvailableTransitions::Response> response) {
          std::lock_guard<std::recursive_mutex> lock(mutex_);
          for (const auto& one : kTransitions) {
            if (one.start == state_.id()) {
              response->available_transitions.push_back(described(one));
            }
          }
        },
        rclcpp::ServicesQoS(), nullptr));
    add(rclcpp::create_service<srv::GetAvailableTransitions>(
        base, services, prefix + "get_transition_graph",
        [](const std::shared_ptr<srv::GetAvailableTransitions::Request>,
           std::shared_ptr<srv::GetAvailableTransitions::Response> response) {
          for (const auto& one : kTransitions) {
            response->available_transitions.push_back(described(one));
          }
        },
        rclcpp::ServicesQoS(), nullptr));
  }

  const TransitionRow* found(uint8_t id, const std::string& label = "") const {
    for (const auto& one : kTransitions) {
      if (one.start == state_.id() && (label.empty() ? one.id == id : one.label == label)) {
        return &one;
      }
    }
    return nullptr;
  }

  bool change(uint8_t id, CallbackReturn& code) {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    const TransitionRow* row = found(id);
    if (!row) {
      RCLCPP_ERROR(node_->get_logger(),
                   "Unable to start transition %u from current state %s: Transition is not "
                   "registered.",
                   id, state_.label().c_str());
      code = CallbackReturn::ERROR;
      return false;
    }
    const State before = state_;
    go(*row);
    code = call(row->goal, before);
    go(*found(0, label_of(code)));
    if (state_.id() == kErrorProcessing) {
      RCLCPP_WARN(node_->get_logger(), "Error occurred while doing error handling.");
      const CallbackReturn error_code = call(kErrorProcessing, before);
      go(*found(0, label_of(error_code)));
    }
    return true;
  }

  void go(const TransitionRow& row) {
    state_ = State(row.goal, label_of(row.goal));
    if (!events_) return;
    lifecycle_msgs::msg::TransitionEvent event;
    event.timestamp = static_cast<uint64_t>(node_->now().nanoseconds());
    event.transition = described(row).transition;
    event.start_state = described(row).start_state;
    event.goal_state = described(row).goal_state;
    events_->publish(event);
  }

  CallbackReturn call(uint8_t during, const State& before) {
    try {
      const auto own = callbacks_.find(during);
      if (own != callbacks_.end()) return own->second(before);
      switch (during) {
        case kConfiguring:
          return node_->on_configure(before);
        case kCleaningUp:
          return node_->on_cleanup(before);
        case kShuttingDown:
          return node_->on_shutdown(before);
        case kActivating:
          return node_->on_activate(before);
        case kDeactivating:
          return node_->on_deactivate(before);
        default:
          return node_->on_error(before);
      }
    } catch (const std::exception& error) {
      RCLCPP_ERROR(node_->get_logger(), "Caught exception in callback for transition %u: %s",
                   during, error.what());
      return CallbackReturn::ERROR;
    }
  }

  bool register_callback(uint8_t during, Callback callback) {
    callbacks_[during] = std::move(callback);
    return true;
  }

  template <class Function>
  void each_entity(Function function) {
    std::vector<std::shared_ptr<ManagedEntityInterface>> strong;
    {
      std::lock_guard<std::recursive_mutex> lock(mutex_);
      for (const auto& one : entities) {
        if (auto found = one.lock()) strong.push_back(std::move(found));
      }
      entities.assign(strong.begin(), strong.end());
    }
    for (const auto& one : strong) function(*one);
  }

  void add(const rclcpp::ServiceBase::SharedPtr& service) { services_.push_back(service); }

  LifecycleNode* node_;
  std::recursive_mutex mutex_;
  State state_;
  std::map<uint8_t, Callback> callbacks_;
  std::vector<std::weak_ptr<ManagedEntityInterface>> entities;
  std::vector<std::weak_ptr<rclcpp::TimerBase>> timers;
  rclcpp::Publisher<lifecycle_msgs::msg::TransitionEvent>::SharedPtr events_;
  std::vector<rclcpp::ServiceBase::SharedPtr> services_;
};

LifecycleNode::LifecycleNode(const std::string& node_name, const rclcpp::NodeOptions& options,
                             bool enable_communication_interface)
    : LifecycleNode(node_name, "", options, enable_communication_interface) {}

LifecycleNode::LifecycleNode(const std::string& node_name, const std::string& namespace_,
                             const rclcpp::NodeOptions& options,
                             bool enable_communication_interface)
    : NodeFunctions(node_name, namespace_, options), impl_(std::make_unique<Impl>(this)) {
  if (enable_communication_interface) impl_->offer();
}

LifecycleNode::~LifecycleNode() = default;

const State& LifecycleNode::get_current_state() const { return impl_->state_; }

std::vector<State> LifecycleNode::get_available_states() const {
  std::vector<State> states;
  for (const auto& one : kStates) states.emplace_back(one.id, one.label);
  return states;
}

std::vector<Transition> LifecycleNode::get_available_transitions() const {
  std::vector<Transition> transitions;
  std::lock_guard<std::recursive_mutex> lock(impl_->mutex_);
  for (const auto& one : kTransitions) {
    if (one.start == impl_->state_.id()) transitions.push_back(made_of(one));
  }
  return transitions;
}

std::vector<Transition> LifecycleNode::get_transition_graph() const {
  std::vector<Transition> transitions;
  for (const auto& one : kTransitions) transitions.push_back(made_of(one));
  return transitions;
}

const State& LifecycleNode::trigger_transition(const Transition& transition) {
  return trigger_transition(transition.id());
}
const State& LifecycleNode::trigger_transition(const Transition& transition, CallbackReturn& code) {
  return trigger_transition(transition.id(), code);
}
const State& LifecycleNode::trigger_transition(uint8_t transition_id) {
  CallbackReturn code;
  return trigger_transition(transition_id, code);
}
const State& LifecycleNode::trigger_transition(uint8_t transition_id, CallbackReturn& code) {
  impl_->change(transition_id, code);
  return impl_->state_;
}

#define GAZELLE_LIFECYCLE_TRIGGER(name, id)                    \
  const State& LifecycleNode::name() {                         \
    CallbackReturn code;                                       \
    return name(code);                                         \
  }                                                            \
  const State& LifecycleNode::name(CallbackReturn& code) {     \
    return trigger_transition(static_cast<uint8_t>(id), code); \
  }
GAZELLE_LIFECYCLE_TRIGGER(configure, 1)
GAZELLE_LIFECYCLE_TRIGGER(cleanup, 2)
GAZELLE_LIFECYCLE_TRIGGER(activate, 3)
GAZELLE_LIFECYCLE_TRIGGER(deactivate, 4)
#undef GAZELLE_LIFECYCLE_TRIGGER

const State& LifecycleNode::shutdown() {
  CallbackReturn code;
  return shutdown(code);
}
const State& LifecycleNode::shutdown(CallbackReturn& code) {
  std::lock_guard<std::recursive_mutex> lock(impl_->mutex_);
  // Each state has a shutdown of its own.
  const auto* row = impl_->found(0, "shutdown");
  return trigger_transition(row ? row->id : static_cast<uint8_t>(5), code);
}

bool LifecycleNode::register_on_configure(Callback callback) {
  return impl_->register_callback(kConfiguring, std::move(callback));
}
bool LifecycleNode::register_on_cleanup(Callback callback) {
  return impl_->register_callback(kCleaningUp, std::move(callback));
}
bool LifecycleNode::register_on_shutdown(Callback callback) {
  return impl_->register_callback(kShuttingDown, std::move(callback));
}
bool LifecycleNode::register_on_activate(Callback callback) {
  return impl_->register_callback(kActivating, std::move(callback));
}
bool LifecycleNode::register_on_deactivate(Callback callback) {
  return impl_->register_callback(kDeactivating, std::move(callback));
}
bool LifecycleNode::register_on_error(Callback callback) {
  return impl_->register_callback(kErrorProcessing, std::move(callback));
}

CallbackReturn LifecycleNode::on_activate(const State&) {
  impl_->each_entity([](ManagedEntityInterface& one) { one.on_activate(); });
  return CallbackReturn::SUCCESS;
}

CallbackReturn LifecycleNode::on_deactivate(const State&) {
  impl_->each_entity([](ManagedEntityInterface& one) { one.on_deactivate(); });
  return CallbackReturn::SUCCESS;
}

void LifecycleNode::add_managed_entity(std::weak_ptr<ManagedEntityInterface> entity) {
  std::lock_guard<std::recursive_mutex> lock(impl_->mutex_);
  impl_->entities.push_back(std::move(entity));
}

void LifecycleNode::add_timer_handle(std::shared_ptr<rclcpp::TimerBase> timer) {
  impl_->timers.push_back(timer);
}

}  // namespace rclcpp_lifecycle
