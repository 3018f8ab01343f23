// What listeners made of parameter files have in common. A listener's class adds the parameters:
// a structure, and a function that visits each of its members with what is said of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <rcl_interfaces/msg/parameter_descriptor.hpp>
#include <rcl_interfaces/msg/set_parameters_result.hpp>
#include <rclcpp/clock.hpp>
#include <rclcpp/exceptions.hpp>
#include <rclcpp/logger.hpp>
#include <rclcpp/logging.hpp>
#include <rclcpp/node_interfaces/node_parameters_interface.hpp>
#include <rclcpp/parameter.hpp>
#include <rclcpp/parameter_value.hpp>
#include <rclcpp/time.hpp>

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <parameter_traits/parameter_traits.hpp>
#include <rsl/parameter_validators.hpp>
#include <rsl/static_string.hpp>
#include <rsl/static_vector.hpp>

namespace gazelle {
namespace parameters {

using Descriptor = rcl_interfaces::msg::ParameterDescriptor;
using Checked = tl::expected<void, std::string>;

// What a file says of one parameter.
struct Spec {
  std::string name;
  const char* description;
  const char* additional_constraints;
  bool is_read_only;
  bool has_default;
  void (*limit)(Descriptor&);                     // null without limits
  Checked (*validate)(const rclcpp::Parameter&);  // null where every value is right
};

inline void limit(Descriptor& descriptor, double lower, double upper) {
  descriptor.floating_point_range.resize(1);
  descriptor.floating_point_range[0].from_value = lower;
  descriptor.floating_point_range[0].to_value = upper;
}
inline void limit(Descriptor& descriptor, std::int64_t lower, std::int64_t upper) {
  descriptor.integer_range.resize(1);
  descriptor.integer_range[0].from_value = lower;
  descriptor.integer_range[0].to_value = upper;
}

inline bool holds(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

// A member's type as parameters know it.
template <class T>
struct Stored {
  using type = T;
  static const T& out(const T& value) { return value; }
};
template <std::size_t capacity>
struct Stored<rsl::StaticString<capacity>> {
  using type = std::string;
  static std::string out(const rsl::StaticString<capacity>& value) { return rsl::to_string(value); }
};
template <class T, std::size_t capacity>
struct Stored<rsl::StaticVector<T, capacity>> {
  using type = std::vector<T>;
  static std::vector<T> out(const rsl::StaticVector<T, capacity>& value) {
    return rsl::to_vector(value);
  }
};

template <class T>
rclcpp::ParameterType type_of() {
  return rclcpp::ParameterValue(typename Stored<T>::type()).get_type();
}

// `Parameters` is the structure, `Visit` has `static void visit(Parameters &, Visitor &&)` and
// `static void prune(Parameters &)`, which forgets entries of maps whose keys are gone.
template <class Parameters, class Stack, class Visit>
class Listener {
 public:
  using Interface = std::shared_ptr<rclcpp::node_interfaces::NodeParametersInterface>;
  using userParameterUpdateCB = std::function<void(const Parameters&)>;

  Listener(const Interface& interface, rclcpp::Logger logger, const std::string& prefix)
      : prefix_(prefix), interface_(interface), logger_(std::move(logger)) {
    if (!prefix_.empty() && prefix_.back() != '.') {
      prefix_ += '.';
    }
    declare_params();
    handle_ = interface_->add_on_set_parameters_callback(
        [this](const std::vector<rclcpp::Parameter>& changed) { return update(changed); });
  }

  Parameters get_params() const {
    const std::lock_guard<std::mutex> guard(lock_);
    return parameters_;
  }
  bool try_update_params(Parameters& parameters) const {
    const std::unique_lock<std::mutex> guard(lock_, std::try_to_lock);
    if (!guard.owns_lock() || parameters.__stamp == parameters_.__stamp) {
      return false;
    }
    parameters = parameters_;
    return true;
  }
  bool try_get_params(Parameters& parameters) const {
    const std::unique_lock<std::mutex> guard(lock_, std::try_to_lock);
    if (guard.owns_lock() && parameters.__stamp != parameters_.__stamp) {
      parameters = parameters_;
    }
    return guard.owns_lock();
  }
  bool is_old(const Parameters& other) const {
    const std::lock_guard<std::mutex> guard(lock_);
    return parameters_.__stamp != other.__stamp;
  }
  Stack get_stack_params() const { return Visit::stack(get_params()); }

  void setUserCallback(const userParameterUpdateCB& callback) { callback_ = callback; }
  void clearUserCallback() { callback_ = {}; }

  void declare_params() {
    Parameters parameters = get_params();
    declare_all(parameters);
    take(parameters);
  }

  // After the keys of a map have changed: parameters of new keys are declared. Those of old keys
  // leave the structure and stay declared, for rclcpp undeclares nothing that has a fixed type.
  void refresh_dynamic_parameters() {
    Parameters parameters = get_params();
    Visit::prune(parameters);
    declare_all(parameters);
    take(parameters);
  }

  rcl_interfaces::msg::SetParametersResult update(const std::vector<rclcpp::Parameter>& changed) {
    Parameters parameters = get_params();
    Checked checked;
    Visit::visit(parameters, [&](const Spec& spec, auto& member) {
      const std::string name = prefix_ + spec.name;
      for (const rclcpp::Parameter& parameter : changed) {
        if (checked && parameter.get_name() == name) {
          checked = assign(spec, parameter, member);
        }
      }
    });
    if (checked) {
      take(parameters);
      if (callback_) callback_(parameters);
    }
    return rsl::to_parameter_result_msg(checked);
  }

 private:
  void declare_all(Parameters& parameters) {
    Visit::visit(parameters, [&](const Spec& spec, auto& member) { declare(spec, member); });
  }

  template <class T>
  void declare(const Spec& spec, T& member) {
    const std::string name = prefix_ + spec.name;
    if (!interface_->has_parameter(name)) {
      Descriptor descriptor;
      descriptor.description = spec.description;
      descriptor.additional_constraints = spec.additional_constraints;
      descriptor.read_only = spec.is_read_only;
      if (spec.limit != nullptr) spec.limit(descriptor);
      if (spec.has_default) {
        interface_->declare_parameter(name, rclcpp::ParameterValue(Stored<T>::out(member)),
                                      descriptor);
      } else {
        interface_->declare_parameter(name, type_of<T>(), descriptor);
      }
    }
    const rclcpp::Parameter parameter = interface_->get_parameter(name);
    if (const Checked checked = assign(spec, parameter, member); !checked) {
      throw rclcpp::exceptions::InvalidParameterValueException(
          "Invalid value set during initialization for parameter '" + name +
          "': " + checked.error());
    }
    RCLCPP_DEBUG(logger_, "%s: %s", name.c_str(), parameter.value_to_string().c_str());
  }

  template <class T>
  static Checked assign(const Spec& spec, const rclcpp::Parameter& parameter, T& member) {
    if (spec.validate != nullptr) {
      if (Checked checked = spec.validate(parameter); !checked) return checked;
    }
    member = T(parameter.get_value<typename Stored<T>::type>());
    return {};
  }

  void take(Parameters& parameters) {
    parameters.__stamp = clock_.now();
    const std::lock_guard<std::mutex> guard(lock_);
    parameters_ = parameters;
  }

  std::string prefix_;
  Parameters parameters_;
  rclcpp::Clock clock_;
  Interface interface_;
  std::shared_ptr<rclcpp::node_interfaces::OnSetParametersCallbackHandle> handle_;
  userParameterUpdateCB callback_;
  rclcpp::Logger logger_;
  mutable std::mutex lock_;
};

}  // namespace parameters
}  // namespace gazelle
