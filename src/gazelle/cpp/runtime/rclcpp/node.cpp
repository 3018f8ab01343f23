// Nodes and their parts, but for parameters and the graph.
#include "rclcpp/node.hpp"

#include <algorithm>
#include <cctype>
#include <mutex>
#include <utility>

#include "clock_impl.hpp"
#include "gazelle/core.hpp"
#include "name_errors.hpp"
#include "node_parts.hpp"
#include "rcl_interfaces/srv/get_logger_levels.hpp"
#include "rcl_interfaces/srv/set_logger_levels.hpp"
#include "rclcpp/detail/log_arguments.hpp"
#include "rclcpp/expand_topic_or_service_name.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {
namespace {

using namespace node_interfaces;  // NOLINT: every part of a node is made below

class Base : public NodeBaseInterface {
 public:
  Base(const std::string& name, const std::string& namespace_, const NodeOptions& options)
      : context_(options.context()),
        intra_process_(options.use_intra_process_comms()),
        statistics_(options.enable_topic_statistics()) {
    if (!context_ || !context_->is_valid()) {
      throw exceptions::RCLInvalidArgument(
          RCL_RET_NOT_INIT,
          "failed to create a node: the given context is not valid, either rcl_init() was not "
          "called or rcl_shutdown() was called.");
    }
    check(name, namespace_);
    gazelle::NodeOptions wanted;
    wanted.name = name;
    wanted.namespace_ = namespace_;
    wanted.ros_version = 2;
    wanted.rosout = options.enable_rosout();
    wanted.use_global_arguments = options.use_global_arguments();
    wanted.arguments = options.arguments();
    try {
      node_ = gazelle::GraphNode::create(wanted);
    } catch (const gazelle::Error& error) {
      if (detail::is_name_error(error)) {
        throw exceptions::InvalidNodeNameError(name.c_str(), error.what(), 0);
      }
      if (error.kind == "RosArgumentError") {
        throw exceptions::RCLInvalidROSArgsError(RCL_RET_INVALID_ROS_ARGS, error.what());
      }
      throw exceptions::RCLError(RCL_RET_ERROR, error.what());
    }
    notify_ = std::make_shared<GuardCondition>(context_);
    handle_ = std::make_shared<rcl_node_t>();
    handle_->impl = this;
    default_group_ = create_callback_group(CallbackGroupType::MutuallyExclusive, true);
    std::vector<std::string> words{"--ros-args"};
    for (const auto& level : node_->details()["log_levels"].members()) {
      words.push_back("--log-level");
      words.push_back(level.first + ":=" + level.second.as_string());
    }
    detail::use_log_arguments(words);
  }

  ~Base() override { node_->shutdown(); }

  const char* get_name() const override { return node_->name().c_str(); }
  const char* get_namespace() const override { return node_->namespace_().c_str(); }
  const char* get_fully_qualified_name() const override { return node_->full_name().c_str(); }
  Context::SharedPtr get_context() override { return context_; }
  rcl_node_t* get_rcl_node_handle() override { return handle_.get(); }
  const rcl_node_t* get_rcl_node_handle() const override { return handle_.get(); }
  std::shared_ptr<rcl_node_t> get_shared_rcl_node_handle() override { return handle_; }
  std::shared_ptr<const rcl_node_t> get_shared_rcl_node_handle() const override { return handle_; }

  CallbackGroup::SharedPtr create_callback_group(
      CallbackGroupType type, bool automatically_add_to_executor_with_node) override {
    auto group = std::make_shared<CallbackGroup>(type, automatically_add_to_executor_with_node);
    {
      std::lock_guard<std::mutex> lock(mutex_);
      groups_.push_back(group);
      for (const auto& one : wakers_) {
        if (const auto waker = one.lock()) group->add_waker(waker);
      }
    }
    detail::entities_changed();
    trigger_notify_guard_condition();
    return group;
  }
  CallbackGroup::SharedPtr get_default_callback_group() override { return default_group_; }
  bool callback_group_in_node(CallbackGroup::SharedPtr group) override {
    std::lock_guard<std::mutex> lock(mutex_);
    return std::any_of(groups_.begin(), groups_.end(),
                       [&group](const auto& one) { return one.lock() == group; });
  }
  void for_each_callback_group(const CallbackGroupFunction& function) override {
    std::vector<CallbackGroup::SharedPtr> strong;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      for (const auto& one : groups_) {
        if (auto group = one.lock()) strong.push_back(std::move(group));
      }
      groups_.assign(strong.begin(), strong.end());
    }
    for (const auto& one : strong) function(one);
  }
  std::atomic_bool& get_associated_with_executor_atomic() override { return associated_; }
  GuardCondition& get_notify_guard_condition() override { return *notify_; }
  GuardCondition::SharedPtr get_shared_notify_guard_condition() override { return notify_; }
  void trigger_notify_guard_condition() override {
    std::vector<std::shared_ptr<detail::Waker>> strong;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      for (const auto& one : wakers_) {
        if (auto waker = one.lock()) strong.push_back(std::move(waker));
      }
    }
    for (const auto& one : strong) one->ring();
    if (notify_) notify_->trigger();
  }
  bool get_use_intra_process_default() const override { return intra_process_; }
  bool get_enable_topic_statistics_default() const override { return statistics_; }
  std::string resolve_topic_or_service_name(const std::string& name, bool is_service,
                                            bool only_expand) const override {
    std::string found;
    const auto resolve = [&]() { found = node_->resolve(name, !only_expand); };
    if (is_service) {
      detail::with_service_errors(name, resolve);
    } else {
      detail::with_topic_errors(name, resolve);
    }
    return found;
  }
  const std::shared_ptr<gazelle::GraphNode>& graph_node() const override { return node_; }
  void add_waker(const std::shared_ptr<detail::Waker>& waker) override {
    std::lock_guard<std::mutex> lock(mutex_);
    wakers_.push_back(waker);
  }
  void remove_waker(const detail::Waker* waker) override {
    std::lock_guard<std::mutex> lock(mutex_);
    wakers_.erase(std::remove_if(wakers_.begin(), wakers_.end(),
                                 [waker](const auto& one) {
                                   const auto strong = one.lock();
                                   return !strong || strong.get() == waker;
                                 }),
                  wakers_.end());
  }

 private:
  static void check(const std::string& name, const std::string& namespace_) {
    const auto is_part = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
    };
    if (name.empty()) {
      throw exceptions::InvalidNodeNameError("", "node name must not be empty", 0);
    }
    for (std::size_t i = 0; i < name.size(); ++i) {
      if (!is_part(name[i])) {
        throw exceptions::InvalidNodeNameError(
            name.c_str(), "node name must not contain characters other than alphanumerics or '_'",
            i);
      }
    }
    if (std::isdigit(static_cast<unsigned char>(name[0]))) {
      throw exceptions::InvalidNodeNameError(name.c_str(), "node name must not start with a number",
                                             0);
    }
    for (std::size_t i = 0; i < namespace_.size(); ++i) {
      if (!is_part(namespace_[i]) && namespace_[i] != '/') {
        throw exceptions::InvalidNamespaceError(
            namespace_.c_str(),
            "namespace must not contain characters other than alphanumerics, '_', or '/'", i);
      }
    }
  }

  const Context::SharedPtr context_;
  const bool intra_process_;
  const bool statistics_;
  std::shared_ptr<gazelle::GraphNode> node_;
  std::shared_ptr<rcl_node_t> handle_;
  GuardCondition::SharedPtr notify_;
  std::mutex mutex_;
  std::vector<CallbackGroup::WeakPtr> groups_;
  std::vector<std::weak_ptr<detail::Waker>> wakers_;
  CallbackGroup::SharedPtr default_group_;
  std::atomic_bool associated_{false};
};

/// Whatever is added goes to its group, or to the node's own.
CallbackGroup::SharedPtr group_for(NodeBaseInterface& base, const CallbackGroup::SharedPtr& given,
                                   const char* what) {
  if (!given) return base.get_default_callback_group();
  if (!base.callback_group_in_node(given)) {
    throw std::runtime_error(std::string("Cannot create ") + what + ", group not in node.");
  }
  return given;
}

class Timers : public NodeTimersInterface {
 public:
  explicit Timers(NodeBaseInterface::SharedPtr base) : base_(std::move(base)) {}
  void add_timer(TimerBase::SharedPtr timer, CallbackGroup::SharedPtr group) override {
    group_for(*base_, group, "timer")->add(timer);
  }

 private:
  NodeBaseInterface::SharedPtr base_;
};

class Topics : public NodeTopicsInterface {
 public:
  Topics(NodeBaseInterface::SharedPtr base, NodeTimersInterface::SharedPtr timers)
      : base_(std::move(base)), timers_(std::move(timers)) {}
  void add_publisher(PublisherBase::SharedPtr publisher, CallbackGroup::SharedPtr group) override {
    const auto where = group_for(*base_, group, "publisher");
    for (const auto& one : publisher->get_event_handlers()) where->add(one.second);
  }
  void add_subscription(SubscriptionBase::SharedPtr subscription,
                        CallbackGroup::SharedPtr group) override {
    const auto where = group_for(*base_, group, "subscription");
    where->add(subscription);
    for (const auto& one : subscription->get_event_handlers()) where->add(one.second);
  }
  NodeBaseInterface* get_node_base_interface() const override { return base_.get(); }
  NodeTimersInterface* get_node_timers_interface() const override { return timers_.get(); }
  std::string resolve_topic_name(const std::string& name, bool only_expand) const override {
    return base_->resolve_topic_or_service_name(name, false, only_expand);
  }

 private:
  NodeBaseInterface::SharedPtr base_;
  NodeTimersInterface::SharedPtr timers_;
};

class Services : public NodeServicesInterface {
 public:
  explicit Services(NodeBaseInterface::SharedPtr base) : base_(std::move(base)) {}
  void add_client(ClientBase::SharedPtr client, CallbackGroup::SharedPtr group) override {
    group_for(*base_, group, "client")->add(client);
  }
  void add_service(ServiceBase::SharedPtr service, CallbackGroup::SharedPtr group) override {
    group_for(*base_, group, "service")->add(service);
  }
  std::string resolve_service_name(const std::string& name, bool only_expand) const override {
    return base_->resolve_topic_or_service_name(name, true, only_expand);
  }

 private:
  NodeBaseInterface::SharedPtr base_;
};

class Waitables : public NodeWaitablesInterface {
 public:
  explicit Waitables(NodeBaseInterface::SharedPtr base) : base_(std::move(base)) {}
  void add_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) override {
    group_for(*base_, group, "waitable")->add(waitable);
  }
  void remove_waitable(Waitable::SharedPtr waitable,
                       CallbackGroup::SharedPtr group) noexcept override {
    (group ? group : base_->get_default_callback_group())->remove(waitable.get());
  }

 private:
  NodeBaseInterface::SharedPtr base_;
};

class Logging : public NodeLoggingInterface {
 public:
  explicit Logging(const NodeBaseInterface::SharedPtr& base)
      : logger_(rclcpp::get_logger(name(*base))) {
    detail::attach_logger(logger_.get_name(), base->graph_node());
  }
  Logger get_logger() const override { return logger_; }
  const char* get_logger_name() const override { return logger_.get_name(); }

  /// Others may read and set the levels of this process.
  void offer(const NodeBaseInterface::SharedPtr& base, const NodeServicesInterface::SharedPtr& to) {
    using rcl_interfaces::srv::GetLoggerLevels;
    using rcl_interfaces::srv::SetLoggerLevels;
    const std::string prefix = std::string(base->get_name()) + "/";
    get_ = create_service<GetLoggerLevels>(
        base, to, prefix + "get_logger_levels",
        [](const std::shared_ptr<GetLoggerLevels::Request> request,
           std::shared_ptr<GetLoggerLevels::Response> response) {
          for (const auto& one : request->names) {
            rcl_interfaces::msg::LoggerLevel level;
            level.name = one;
            const int found = rcutils_logging_get_logger_level(one.c_str());
            level.level = static_cast<std::uint32_t>(std::max(found, 0));
            response->levels.push_back(level);
          }
        },
        ServicesQoS(), nullptr);
    set_ = create_service<SetLoggerLevels>(
        base, to, prefix + "set_logger_levels",
        [](const std::shared_ptr<SetLoggerLevels::Request> request,
           std::shared_ptr<SetLoggerLevels::Response> response) {
          for (const auto& one : request->levels) {
            rcl_interfaces::msg::SetLoggerLevelsResult result;
            result.successful =
                rcutils_logging_set_logger_level(one.name.c_str(), static_cast<int>(one.level)) ==
                RCUTILS_RET_OK;
            if (!result.successful) {
              result.reason = rcutils_get_error_string().str;
              rcutils_reset_error();
            }
            response->results.push_back(result);
          }
        },
        ServicesQoS(), nullptr);
  }

 private:
  static std::string name(const NodeBaseInterface& base) {
    std::string full = base.get_fully_qualified_name();
    full.erase(0, full.find_first_not_of('/'));
    std::replace(full.begin(), full.end(), '/', '.');
    return full;
  }
  Logger logger_;
  Service<rcl_interfaces::srv::GetLoggerLevels>::SharedPtr get_;
  Service<rcl_interfaces::srv::SetLoggerLevels>::SharedPtr set_;
};

class NodeClock : public NodeClockInterface {
 public:
  Clock::SharedPtr get_clock() override { return clock_; }
  Clock::ConstSharedPtr get_clock() const override { return clock_; }

 private:
  Clock::SharedPtr clock_ = std::make_shared<Clock>(RCL_ROS_TIME);
};

/// The node's clock follows simulated time where its parameter use_sim_time says so.
class NodeTimeSource : public NodeTimeSourceInterface {
 public:
  NodeTimeSource(const NodeParametersInterface::SharedPtr& parameters, Clock::SharedPtr clock)
      : parameters_(parameters) {
    std::weak_ptr<Clock> weak = clock;
    check_ = parameters->add_on_set_parameters_callback([](const std::vector<Parameter>& changes) {
      rcl_interfaces::msg::SetParametersResult result;
      result.successful = true;
      for (const auto& one : changes) {
        if (one.get_name() == "use_sim_time" && one.get_type() != PARAMETER_BOOL) {
          result.successful = false;
          result.reason = "'use_sim_time' must be a bool";
        }
      }
      return result;
    });
    follow_ =
        parameters->add_post_set_parameters_callback([weak](const std::vector<Parameter>& changes) {
          const auto strong = weak.lock();
          for (const auto& one : changes) {
            if (one.get_name() == "use_sim_time" && one.get_type() == PARAMETER_BOOL && strong) {
              strong->impl().use_sim_time(one.as_bool());
            }
          }
        });
    if (!parameters->has_parameter("use_sim_time")) {
      parameters->declare_parameter("use_sim_time", ParameterValue(false));
    }
    const Parameter found = parameters->get_parameter("use_sim_time");
    if (found.get_type() != PARAMETER_BOOL) {
      RCLCPP_ERROR(get_logger("rclcpp"),
                   "Invalid type '%s' for parameter 'use_sim_time', should be 'bool'",
                   found.get_type_name().c_str());
      throw std::invalid_argument("Invalid type for parameter 'use_sim_time', should be 'bool'");
    }
    clock->impl().use_sim_time(found.as_bool());
  }

 private:
  NodeParametersInterface::SharedPtr parameters_;
  OnSetParametersCallbackHandle::SharedPtr check_;
  PostSetParametersCallbackHandle::SharedPtr follow_;
};

std::string joined(const std::string& space, const std::string& part) {
  if (part.empty()) return space;
  return space == "/" ? "/" + part : space + "/" + part;
}

}  // namespace

namespace detail {

NodeBaseInterface::SharedPtr make_base(const std::string& name, const std::string& namespace_,
                                       const NodeOptions& options) {
  return std::make_shared<Base>(name, namespace_, options);
}

NodeFunctions::NodeFunctions(const std::string& name, const std::string& namespace_,
                             const NodeOptions& options)
    : options_(options),
      base_(make_base(name, namespace_, options)),
      graph_(make_graph(base_)),
      timers_(std::make_shared<Timers>(base_)),
      services_(std::make_shared<Services>(base_)),
      clock_(std::make_shared<NodeClock>()),
      waitables_(std::make_shared<Waitables>(base_)) {
  auto logging = std::make_shared<Logging>(base_);
  logging_ = logging;
  topics_ = std::make_shared<Topics>(base_, timers_);
  if (options.enable_logger_service()) logging->offer(base_, services_);
  parameters_ = make_parameters(base_, topics_, services_, clock_->get_clock(), options);
  time_source_ = std::make_shared<NodeTimeSource>(parameters_, clock_->get_clock());
  type_descriptions_ = std::make_shared<NodeTypeDescriptionsInterface>();
  effective_namespace_ = base_->get_namespace();
}

NodeFunctions::NodeFunctions(const NodeFunctions& other, const std::string& sub_namespace)
    : options_(other.options_),
      sub_namespace_(extend_name_with_sub_namespace(sub_namespace, other.sub_namespace_)),
      base_(other.base_),
      graph_(other.graph_),
      logging_(other.logging_),
      timers_(other.timers_),
      topics_(other.topics_),
      services_(other.services_),
      clock_(other.clock_),
      parameters_(other.parameters_),
      time_source_(other.time_source_),
      type_descriptions_(other.type_descriptions_),
      waitables_(other.waitables_) {
  if (sub_namespace.empty()) {
    throw exceptions::NameValidationError("sub_namespace", "",
                                          "sub-nodes should not extend nodes "
                                          "by an empty sub-namespace",
                                          0);
  }
  if (sub_namespace.front() == '/') {
    throw exceptions::NameValidationError("sub_namespace", sub_namespace.c_str(),
                                          "a sub-namespace should not have a leading /", 0);
  }
  effective_namespace_ = joined(base_->get_namespace(), sub_namespace_);
}

NodeFunctions::~NodeFunctions() {
  // Parts go in the order in which they need one another; the base goes with the last of them.
  waitables_.reset();
  time_source_.reset();
  parameters_.reset();
  clock_.reset();
  services_.reset();
  topics_.reset();
  timers_.reset();
  logging_.reset();
  graph_.reset();
}

std::string NodeFunctions::extended(const std::string& name) const {
  return extend_name_with_sub_namespace(name, sub_namespace_);
}

std::string NodeFunctions::in_sub(const std::string& name) const {
  if (sub_namespace_.empty() || name.empty() || name.front() == '/' || name.front() == '~') {
    return name;
  }
  return sub_namespace_ + "." + name;
}

rcl_interfaces::msg::ParameterDescriptor NodeFunctions::describe_parameter(
    const std::string& name) const {
  const auto found = parameters_->describe_parameters({name});
  if (found.empty()) throw exceptions::ParameterNotDeclaredException(name);
  return found.front();
}

NodeFunctions::OnParametersSetCallbackType NodeFunctions::set_on_parameters_set_callback(
    OnParametersSetCallbackType callback) {
  OnParametersSetCallbackType before;
  if (single_callback_) {
    before = single_callback_->callback;
    parameters_->remove_on_set_parameters_callback(single_callback_.get());
    single_callback_.reset();
  }
  if (callback) single_callback_ = parameters_->add_on_set_parameters_callback(std::move(callback));
  return before;
}

}  // namespace detail

std::string extend_name_with_sub_namespace(const std::string& name,
                                           const std::string& sub_namespace) {
  if (sub_namespace.empty() || name.empty() || name.front() == '/' || name.front() == '~') {
    return name;
  }
  return sub_namespace + "/" + name;
}

std::string expand_topic_or_service_name(const std::string& name, const std::string& node_name,
                                         const std::string& namespace_, bool is_service) {
  const auto refuse = [&](const char* text, std::size_t at) {
    if (is_service) throw exceptions::InvalidServiceNameError(name.c_str(), text, at);
    throw exceptions::InvalidTopicNameError(name.c_str(), text, at);
  };
  if (name.empty()) refuse("topic name must not be empty string", 0);
  if (name.back() == '/') refuse("topic name must not end with a forward slash", name.size() - 1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/' || c == '{' ||
        c == '}' || (c == '~' && i == 0)) {
      continue;
    }
    refuse("topic name must not contain characters other than alphanumerics, '_', '~', '{', or '}'",
           i);
  }
  std::string expanded = name;
  const std::string own = joined(namespace_, node_name);
  if (expanded.front() == '~') expanded = own + expanded.substr(1);
  for (const auto& one : {std::make_pair(std::string("{node}"), node_name),
                          std::make_pair(std::string("{ns}"), namespace_),
                          std::make_pair(std::string("{namespace}"), namespace_)}) {
    for (std::size_t at; (at = expanded.find(one.first)) != std::string::npos;) {
      expanded.replace(at, one.first.size(), one.second);
    }
  }
  return expanded.front() == '/' ? expanded : joined(namespace_, expanded);
}

Node::Node(const std::string& node_name, const NodeOptions& options)
    : Node(node_name, "", options) {}

Node::Node(const std::string& node_name, const std::string& namespace_, const NodeOptions& options)
    : NodeFunctions(node_name, namespace_, options) {}

Node::Node(const Node& other, const std::string& sub_namespace)
    : std::enable_shared_from_this<Node>(), NodeFunctions(other, sub_namespace) {}

Node::~Node() = default;

const std::string& Node::get_sub_namespace() const { return sub_namespace_; }
const std::string& Node::get_effective_namespace() const { return effective_namespace_; }

Node::SharedPtr Node::create_sub_node(const std::string& sub_namespace) {
  return std::shared_ptr<Node>(new Node(*this, sub_namespace));
}

}  // namespace rclcpp
