// Parameters of a node: declared, set, checked, told to others, and offered by six services.
#include <algorithm>
#include <cmath>
#include <limits>
#include <list>
#include <map>
#include <mutex>
#include <utility>

#include "gazelle/core.hpp"
#include "node_parts.hpp"
#include "parameter_json.hpp"
#include "rcl_interfaces/msg/parameter_event.hpp"
#include "rcl_interfaces/srv/describe_parameters.hpp"
#include "rcl_interfaces/srv/get_parameter_types.hpp"
#include "rcl_interfaces/srv/get_parameters.hpp"
#include "rcl_interfaces/srv/list_parameters.hpp"
#include "rcl_interfaces/srv/set_parameters.hpp"
#include "rcl_interfaces/srv/set_parameters_atomically.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {
namespace {

using namespace node_interfaces;  // NOLINT: parameters are a part of nodes
using rcl_interfaces::msg::ListParametersResult;
using rcl_interfaces::msg::ParameterDescriptor;
using rcl_interfaces::msg::ParameterEvent;
using rcl_interfaces::msg::SetParametersResult;

SetParametersResult success() {
  SetParametersResult result;
  result.successful = true;
  return result;
}

SetParametersResult failure(const std::string& reason) {
  SetParametersResult result;
  result.successful = false;
  result.reason = reason;
  return result;
}

std::string wrong_type(const std::string& name, const std::string& wanted,
                       const std::string& given) {
  return "Wrong parameter type, parameter {" + name + "} is of type {" + wanted +
         "}, setting it to {" + given + "} is not allowed.";
}

bool nearly_equal(double a, double b, std::size_t ulp = 100) {
  return std::fabs(a - b) <=
         std::numeric_limits<double>::epsilon() * std::fabs(a + b) * static_cast<double>(ulp);
}

/// Why a value is out of the range that its descriptor gives, empty where it is not.
std::string range_fault(const ParameterDescriptor& descriptor, const ParameterValue& value) {
  const auto fault = [&](const char* kind) {
    return "Parameter {" + descriptor.name + "} doesn't comply with " + kind + " range.";
  };
  if (!descriptor.integer_range.empty() && value.get_type() == PARAMETER_INTEGER) {
    const auto& range = descriptor.integer_range.front();
    const int64_t number = value.get<int64_t>();
    if (number == range.from_value || number == range.to_value) return "";
    if (number < range.from_value || number > range.to_value) return fault("integer");
    if (range.step == 0) return "";
    const auto past = static_cast<uint64_t>(number - range.from_value);
    return past % range.step == 0 ? "" : fault("integer");
  }
  if (!descriptor.floating_point_range.empty() && value.get_type() == PARAMETER_DOUBLE) {
    const auto& range = descriptor.floating_point_range.front();
    const double number = value.get<double>();
    if (nearly_equal(number, range.from_value) || nearly_equal(number, range.to_value)) return "";
    if (number < range.from_value || number > range.to_value) return fault("floating point");
    if (range.step == 0.0) return "";
    const double steps = std::round((number - range.from_value) / range.step);
    return nearly_equal(number, range.from_value + steps * range.step) ? ""
                                                                       : fault("floating point");
  }
  return "";
}

/// Lets no callback of parameters set parameters.
class InCallback {
 public:
  explicit InCallback(bool& flag) : flag_(flag) {
    if (flag) {
      throw exceptions::ParameterModifiedInCallbackException(
          "cannot set or declare a parameter, or change the callback from within set callback");
    }
    flag = true;
  }
  ~InCallback() { flag_ = false; }

 private:
  bool& flag_;
};

template <class Handle>
using Handles = std::list<std::weak_ptr<Handle>>;

class Parameters : public NodeParametersInterface {
 public:
  Parameters(const NodeBaseInterface::SharedPtr& base, const NodeTopicsInterface::SharedPtr& topics,
             Clock::SharedPtr clock, const NodeOptions& options)
      : base_(base),
        clock_(std::move(clock)),
        allow_undeclared_(options.allow_undeclared_parameters()) {
    for (const auto& one : base->graph_node()->details()["parameters"].members()) {
      overrides_[one.first] = detail::value_from_json(one.second);
    }
    for (const auto& one : options.parameter_overrides()) {
      overrides_[one.get_name()] = one.get_parameter_value();
    }
    if (options.start_parameter_event_publisher()) {
      const QoS qos = detail::overridden_qos(
          this, "/parameter_events", options.parameter_event_qos(),
          QosOverridingOptions({QosPolicyKind::Depth, QosPolicyKind::Durability,
                                QosPolicyKind::History, QosPolicyKind::Reliability}),
          true);
      events_ = std::make_shared<Publisher<ParameterEvent>>(base.get(), "/parameter_events", qos,
                                                            PublisherOptions());
      topics->add_publisher(events_, nullptr);
    }
    if (options.automatically_declare_parameters_from_overrides()) {
      ParameterDescriptor descriptor;
      descriptor.dynamic_typing = true;
      for (const auto& one : overrides_) {
        if (!has_parameter(one.first)) {
          declare_parameter(one.first, one.second, descriptor, true);
        }
      }
    }
  }

  const ParameterValue& declare_parameter(const std::string& name,
                                          const ParameterValue& default_value,
                                          const ParameterDescriptor& descriptor,
                                          bool ignore_override) override {
    return declare(name, default_value.get_type(), default_value, descriptor, ignore_override);
  }

  const ParameterValue& declare_parameter(const std::string& name, ParameterType type,
                                          const ParameterDescriptor& descriptor,
                                          bool ignore_override) override {
    if (type == PARAMETER_NOT_SET) {
      throw std::invalid_argument(
          "declare_parameter(): the provided parameter type cannot be PARAMETER_NOT_SET");
    }
    if (descriptor.dynamic_typing) {
      throw std::invalid_argument(
          "declare_parameter(): cannot declare parameter of specific type and pass descriptor "
          "with `dynamic_typing=true`");
    }
    return declare(name, type, ParameterValue(), descriptor, ignore_override);
  }

  void undeclare_parameter(const std::string& name) override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    InCallback guard(in_callback_);
    const auto found = values_.find(name);
    if (found == values_.end()) {
      throw exceptions::ParameterNotDeclaredException("cannot undeclare parameter '" + name +
                                                      "' which has not yet been declared");
    }
    if (found->second.descriptor.read_only) {
      throw exceptions::ParameterImmutableException("cannot undeclare parameter '" + name +
                                                    "' because it is read-only");
    }
    if (!found->second.descriptor.dynamic_typing) {
      throw exceptions::InvalidParameterTypeException(
          name, "cannot undeclare a statically typed parameter");
    }
    const Parameter gone(name, found->second.value);
    values_.erase(found);
    tell({}, {}, {gone});
  }

  bool has_parameter(const std::string& name) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    return values_.count(name) > 0;
  }

  std::vector<SetParametersResult> set_parameters(
      const std::vector<Parameter>& parameters) override {
    std::vector<SetParametersResult> results;
    for (const auto& one : parameters) results.push_back(set_parameters_atomically({one}));
    return results;
  }

  SetParametersResult set_parameters_atomically(const std::vector<Parameter>& given) override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    InCallback guard(in_callback_);
    std::vector<Parameter> parameters = given;
    each(before_, [&](const PreSetParametersCallbackHandle& one) { one.callback(parameters); });
    if (parameters.empty() && !given.empty()) {
      return failure(
          "parameter list cannot be empty, this might be due to pre_set_parameters_callback "
          "modifying the original parameters list.");
    }
    for (const auto& one : parameters) {
      const auto found = values_.find(one.get_name());
      if (found == values_.end()) {
        if (!allow_undeclared_) {
          throw exceptions::ParameterNotDeclaredException(
              "parameter '" + one.get_name() + "' cannot be set because it was not declared");
        }
        if (one.get_name().empty()) {
          throw exceptions::InvalidParametersException("parameter name must not be empty");
        }
      } else if (found->second.descriptor.read_only) {
        return failure("parameter '" + one.get_name() + "' cannot be set because it is read-only");
      }
    }
    const std::string fault = check(parameters);
    if (!fault.empty()) return failure(fault);
    const SetParametersResult asked = ask(parameters);
    if (!asked.successful) return asked;
    std::vector<Parameter> fresh, changed, deleted;
    for (const auto& one : parameters) store(one, fresh, changed, deleted);
    each(after_,
         [&](const PostSetParametersCallbackHandle& handle) { handle.callback(parameters); });
    tell(fresh, changed, deleted);
    return success();
  }

  std::vector<Parameter> get_parameters(const std::vector<std::string>& names) const override {
    std::vector<Parameter> found;
    for (const auto& one : names) found.push_back(get_parameter(one));
    return found;
  }

  Parameter get_parameter(const std::string& name) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    const auto found = values_.find(name);
    if (found != values_.end()) {
      if (found->second.value.get_type() != PARAMETER_NOT_SET ||
          found->second.descriptor.dynamic_typing) {
        return Parameter(name, found->second.value);
      }
      throw exceptions::ParameterUninitializedException(name);
    }
    if (allow_undeclared_) return Parameter(name);
    throw exceptions::ParameterNotDeclaredException(name);
  }

  bool get_parameter(const std::string& name, Parameter& parameter) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    const auto found = values_.find(name);
    if (found == values_.end() || found->second.value.get_type() == PARAMETER_NOT_SET) return false;
    parameter = Parameter(name, found->second.value);
    return true;
  }

  bool get_parameters_by_prefix(const std::string& prefix,
                                std::map<std::string, Parameter>& parameters) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    const std::string begin = prefix.empty() ? prefix : prefix + ".";
    bool any = false;
    for (const auto& one : values_) {
      if (one.first.size() <= begin.size() || one.first.compare(0, begin.size(), begin) != 0) {
        continue;
      }
      parameters[one.first.substr(begin.size())] = Parameter(one.first, one.second.value);
      any = true;
    }
    return any;
  }

  std::vector<ParameterDescriptor> describe_parameters(
      const std::vector<std::string>& names) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    std::vector<ParameterDescriptor> found;
    for (const auto& name : names) {
      const auto one = values_.find(name);
      if (one != values_.end()) {
        found.push_back(one->second.descriptor);
      } else if (allow_undeclared_) {
        ParameterDescriptor plain;
        plain.name = name;
        found.push_back(plain);
      } else {
        throw exceptions::ParameterNotDeclaredException(name);
      }
    }
    return found;
  }

  std::vector<uint8_t> get_parameter_types(const std::vector<std::string>& names) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    std::vector<uint8_t> types;
    for (const auto& name : names) {
      const auto one = values_.find(name);
      if (one != values_.end()) {
        types.push_back(one->second.value.get_type());
      } else if (allow_undeclared_) {
        types.push_back(PARAMETER_NOT_SET);
      } else {
        throw exceptions::ParameterNotDeclaredException(name);
      }
    }
    return types;
  }

  ListParametersResult list_parameters(const std::vector<std::string>& prefixes,
                                       uint64_t depth) const override {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    ListParametersResult result;
    for (const auto& one : values_) {
      if (!detail::is_listed(one.first, prefixes, depth)) continue;
      result.names.push_back(one.first);
      const std::size_t dot = one.first.rfind('.');
      if (dot == std::string::npos) continue;
      const std::string prefix = one.first.substr(0, dot);
      if (std::find(result.prefixes.begin(), result.prefixes.end(), prefix) ==
          result.prefixes.end()) {
        result.prefixes.push_back(prefix);
      }
    }
    return result;
  }

  PreSetParametersCallbackHandle::SharedPtr add_pre_set_parameters_callback(
      PreSetParametersCallbackType callback) override {
    return add(before_, std::move(callback));
  }
  OnSetParametersCallbackHandle::SharedPtr add_on_set_parameters_callback(
      OnSetParametersCallbackType callback) override {
    return add(during_, std::move(callback));
  }
  PostSetParametersCallbackHandle::SharedPtr add_post_set_parameters_callback(
      PostSetParametersCallbackType callback) override {
    return add(after_, std::move(callback));
  }
  void remove_pre_set_parameters_callback(const PreSetParametersCallbackHandle* handle) override {
    remove(before_, handle, "Pre set parameter");
  }
  void remove_on_set_parameters_callback(const OnSetParametersCallbackHandle* handle) override {
    remove(during_, handle, "On set parameter");
  }
  void remove_post_set_parameters_callback(const PostSetParametersCallbackHandle* handle) override {
    remove(after_, handle, "Post set parameter");
  }
  const std::map<std::string, ParameterValue>& get_parameter_overrides() const override {
    return overrides_;
  }

  /// Services of the node by which others ask and set.
  void offer(const NodeServicesInterface::SharedPtr& services);

 private:
  const ParameterValue& declare(const std::string& name, ParameterType type,
                                const ParameterValue& default_value, ParameterDescriptor descriptor,
                                bool ignore_override) {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    InCallback guard(in_callback_);
    if (name.empty()) {
      throw exceptions::InvalidParametersException("parameter name must not be empty");
    }
    if (values_.count(name)) {
      throw exceptions::ParameterAlreadyDeclaredException("parameter '" + name +
                                                          "' has already been declared");
    }
    if (type == PARAMETER_NOT_SET && !descriptor.dynamic_typing) {
      throw exceptions::InvalidParameterTypeException(
          name, "cannot declare a statically typed parameter with an uninitialized value");
    }
    descriptor.name = name;
    // A parameter that may change its type is described as of none.
    descriptor.type = descriptor.dynamic_typing ? PARAMETER_NOT_SET : type;
    const auto found = overrides_.find(name);
    const bool overridden = !ignore_override && found != overrides_.end();
    const ParameterValue value =
        overridden ? as_declared(found->second, descriptor) : default_value;
    if (value.get_type() != PARAMETER_NOT_SET) {
      if (!descriptor.dynamic_typing && value.get_type() != type) {
        throw exceptions::InvalidParameterTypeException(
            name, wrong_type(name, to_string(type), to_string(value.get_type())));
      }
      const std::string fault = range_fault(descriptor, value);
      if (!fault.empty())
        throw exceptions::InvalidParameterValueException("parameter '" + name +
                                                         "' could not be set: " + fault);
      const SetParametersResult asked = ask({Parameter(name, value)});
      if (!asked.successful) {
        throw exceptions::InvalidParameterValueException("parameter '" + name +
                                                         "' could not be set: " + asked.reason);
      }
    }
    ParameterInfo& info = values_[name];
    info.value = value;
    info.descriptor = descriptor;
    if (value.get_type() != PARAMETER_NOT_SET) {
      each(after_, [&](const PostSetParametersCallbackHandle& handle) {
        handle.callback({Parameter(name, value)});
      });
    }
    tell({Parameter(name, value)}, {}, {});
    return info.value;
  }

  // An empty list in a file says nothing of its type.
  static ParameterValue as_declared(const ParameterValue& value,
                                    const ParameterDescriptor& descriptor) {
    const bool is_empty_list =
        value.get_type() == PARAMETER_STRING_ARRAY && value.get<std::vector<std::string>>().empty();
    if (!is_empty_list) return value;
    switch (descriptor.type) {
      case PARAMETER_BYTE_ARRAY:
        return ParameterValue(std::vector<uint8_t>());
      case PARAMETER_BOOL_ARRAY:
        return ParameterValue(std::vector<bool>());
      case PARAMETER_INTEGER_ARRAY:
        return ParameterValue(std::vector<int64_t>());
      case PARAMETER_DOUBLE_ARRAY:
        return ParameterValue(std::vector<double>());
      default:
        return value;
    }
  }

  std::string check(const std::vector<Parameter>& parameters) const {
    for (const auto& one : parameters) {
      const auto found = values_.find(one.get_name());
      if (found == values_.end()) continue;
      const auto& descriptor = found->second.descriptor;
      if (!descriptor.dynamic_typing && one.get_type() != descriptor.type) {
        return wrong_type(one.get_name(), to_string(static_cast<ParameterType>(descriptor.type)),
                          one.get_type_name());
      }
      const std::string fault = range_fault(descriptor, one.get_parameter_value());
      if (!fault.empty()) return fault;
    }
    return "";
  }

  SetParametersResult ask(const std::vector<Parameter>& parameters) {
    SetParametersResult result = success();
    each(during_, [&](const OnSetParametersCallbackHandle& one) {
      if (result.successful) result = one.callback(parameters);
    });
    return result;
  }

  void store(const Parameter& one, std::vector<Parameter>& fresh, std::vector<Parameter>& changed,
             std::vector<Parameter>& deleted) {
    const auto found = values_.find(one.get_name());
    if (found == values_.end()) {
      if (one.get_type() == PARAMETER_NOT_SET) return;
      ParameterInfo info;
      info.descriptor.name = one.get_name();
      info.descriptor.dynamic_typing = true;
      info.value = one.get_parameter_value();
      values_.emplace(one.get_name(), std::move(info));
      fresh.push_back(one);
    } else if (one.get_type() == PARAMETER_NOT_SET) {
      deleted.push_back(Parameter(one.get_name(), found->second.value));
      values_.erase(found);
    } else {
      found->second.value = one.get_parameter_value();
      changed.push_back(one);
    }
  }

  void tell(const std::vector<Parameter>& fresh, const std::vector<Parameter>& changed,
            const std::vector<Parameter>& deleted) {
    if (!events_ || (fresh.empty() && changed.empty() && deleted.empty())) return;
    auto event = std::make_unique<ParameterEvent>();
    event->node = base_->get_fully_qualified_name();
    event->stamp = clock_->now();
    for (const auto& one : fresh) event->new_parameters.push_back(one.to_parameter_msg());
    for (const auto& one : changed) event->changed_parameters.push_back(one.to_parameter_msg());
    for (const auto& one : deleted) event->deleted_parameters.push_back(one.to_parameter_msg());
    events_->publish(std::move(event));
  }

  template <class Handle, class Function>
  void each(Handles<Handle>& handles, Function function) {
    for (auto one = handles.begin(); one != handles.end();) {
      if (const auto strong = one->lock()) {
        function(*strong);
        ++one;
      } else {
        one = handles.erase(one);
      }
    }
  }

  // The one added last is called first.
  template <class Handle, class Callback>
  std::shared_ptr<Handle> add(Handles<Handle>& handles, Callback callback) {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    InCallback guard(in_callback_);
    auto made = std::make_shared<Handle>();
    made->callback = std::move(callback);
    handles.push_front(made);
    return made;
  }

  template <class Handle>
  void remove(Handles<Handle>& handles, const Handle* handle, const char* what) {
    std::lock_guard<std::recursive_mutex> lock(mutex_);
    InCallback guard(in_callback_);
    const auto found = std::find_if(handles.begin(), handles.end(), [handle](const auto& one) {
      return one.lock().get() == handle;
    });
    if (found == handles.end()) {
      throw std::runtime_error(std::string(what) + " callback doesn't exist");
    }
    handles.erase(found);
  }

  NodeBaseInterface::SharedPtr base_;
  Clock::SharedPtr clock_;
  const bool allow_undeclared_;
  mutable std::recursive_mutex mutex_;
  std::map<std::string, ParameterInfo> values_;
  std::map<std::string, ParameterValue> overrides_;
  Handles<PreSetParametersCallbackHandle> before_;
  Handles<OnSetParametersCallbackHandle> during_;
  Handles<PostSetParametersCallbackHandle> after_;
  bool in_callback_ = false;
  Publisher<ParameterEvent>::SharedPtr events_;
  std::vector<ServiceBase::SharedPtr> services_;
};

void Parameters::offer(const NodeServicesInterface::SharedPtr& services) {
  using namespace rcl_interfaces::srv;  // NOLINT: the six of them
  const std::string prefix = std::string(base_->get_name()) + "/";
  const QoS qos = ParametersQoS();
  const auto add_one = [&](auto service) { services_.push_back(service); };
  add_one(create_service<GetParameters>(
      base_, services, prefix + "get_parameters",
      [this](const std::shared_ptr<GetParameters::Request> request,
             std::shared_ptr<GetParameters::Response> response) {
        try {
          for (const auto& one : get_parameters(request->names)) {
            response->values.push_back(one.get_value_message());
          }
        } catch (const exceptions::ParameterNotDeclaredException& error) {
          response->values.clear();
          RCLCPP_DEBUG(get_logger("rclcpp"), "Failed to get parameters: %s", error.what());
        } catch (const exceptions::ParameterUninitializedException& error) {
          response->values.clear();
          RCLCPP_DEBUG(get_logger("rclcpp"), "Failed to get parameters: %s", error.what());
        }
      },
      qos, nullptr));
  add_one(create_service<GetParameterTypes>(
      base_, services, prefix + "get_parameter_types",
      [this](const std::shared_ptr<GetParameterTypes::Request> request,
             std::shared_ptr<GetParameterTypes::Response> response) {
        try {
          response->types = get_parameter_types(request->names);
        } catch (const exceptions::ParameterNotDeclaredException& error) {
          RCLCPP_DEBUG(get_logger("rclcpp"), "Failed to get parameter types: %s", error.what());
        }
      },
      qos, nullptr));
  add_one(create_service<SetParameters>(
      base_, services, prefix + "set_parameters",
      [this](const std::shared_ptr<SetParameters::Request> request,
             std::shared_ptr<SetParameters::Response> response) {
        for (const auto& one : request->parameters) {
          try {
            response->results.push_back(
                set_parameters_atomically({Parameter::from_parameter_msg(one)}));
          } catch (const exceptions::ParameterNotDeclaredException& error) {
            response->results.push_back(failure(error.what()));
          } catch (const exceptions::InvalidParametersException& error) {
            response->results.push_back(failure(error.what()));
          }
        }
      },
      qos, nullptr));
  add_one(create_service<SetParametersAtomically>(
      base_, services, prefix + "set_parameters_atomically",
      [this](const std::shared_ptr<SetParametersAtomically::Request> request,
             std::shared_ptr<SetParametersAtomically::Response> response) {
        std::vector<Parameter> parameters;
        for (const auto& one : request->parameters) {
          parameters.push_back(Parameter::from_parameter_msg(one));
        }
        try {
          response->result = set_parameters_atomically(parameters);
        } catch (const exceptions::ParameterNotDeclaredException&) {
          response->result = failure("One or more parameters were not declared before setting");
        }
      },
      qos, nullptr));
  add_one(create_service<DescribeParameters>(
      base_, services, prefix + "describe_parameters",
      [this](const std::shared_ptr<DescribeParameters::Request> request,
             std::shared_ptr<DescribeParameters::Response> response) {
        try {
          response->descriptors = describe_parameters(request->names);
        } catch (const exceptions::ParameterNotDeclaredException& error) {
          RCLCPP_DEBUG(get_logger("rclcpp"), "Failed to describe parameters: %s", error.what());
        }
      },
      qos, nullptr));
  add_one(create_service<ListParameters>(
      base_, services, prefix + "list_parameters",
      [this](const std::shared_ptr<ListParameters::Request> request,
             std::shared_ptr<ListParameters::Response> response) {
        response->result = list_parameters(request->prefixes, request->depth);
      },
      qos, nullptr));
}

}  // namespace

namespace detail {

bool is_listed(const std::string& name, const std::vector<std::string>& prefixes,
               std::uint64_t depth) {
  const auto deep_enough = [depth](const std::string& rest) {
    return depth == 0 ||
           static_cast<std::uint64_t>(std::count(rest.begin(), rest.end(), '.')) < depth;
  };
  if (prefixes.empty()) return deep_enough(name);
  return std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
    if (name == prefix) return true;
    const std::string begin = prefix + ".";
    return name.compare(0, begin.size(), begin) == 0 && deep_enough(name.substr(begin.size()));
  });
}

NodeParametersInterface::SharedPtr make_parameters(NodeBaseInterface::SharedPtr base,
                                                   NodeTopicsInterface::SharedPtr topics,
                                                   NodeServicesInterface::SharedPtr services,
                                                   Clock::SharedPtr clock,
                                                   const NodeOptions& options) {
  auto made = std::make_shared<Parameters>(base, topics, std::move(clock), options);
  if (options.start_parameter_services()) made->offer(services);
  return made;
}

}  // namespace detail
}  // namespace rclcpp
