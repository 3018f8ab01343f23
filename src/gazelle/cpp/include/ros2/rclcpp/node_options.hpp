#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rcl/allocator.h"
#include "rclcpp/context.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

/// What a node is told when it is made; every setter returns the object.
class RCLCPP_PUBLIC NodeOptions {
 public:
  explicit NodeOptions(rcl_allocator_t allocator = rcl_get_default_allocator())
      : allocator_(allocator) {}

#define GAZELLE_RCLCPP_OPTION(Type, name, initial) \
  const Type& name() const { return name##_; }     \
  NodeOptions& name(const Type& value) {           \
    name##_ = value;                               \
    return *this;                                  \
  }                                                \
                                                   \
 private:                                          \
  Type name##_ = initial;                          \
                                                   \
 public:

  GAZELLE_RCLCPP_OPTION(Context::SharedPtr, context, contexts::get_global_default_context())
  GAZELLE_RCLCPP_OPTION(std::vector<std::string>, arguments, {})
  GAZELLE_RCLCPP_OPTION(bool, use_global_arguments, true)
  GAZELLE_RCLCPP_OPTION(bool, enable_rosout, true)
  GAZELLE_RCLCPP_OPTION(bool, use_intra_process_comms, false)
  GAZELLE_RCLCPP_OPTION(bool, enable_topic_statistics, false)
  GAZELLE_RCLCPP_OPTION(bool, start_parameter_services, true)
  GAZELLE_RCLCPP_OPTION(bool, start_parameter_event_publisher, true)
  GAZELLE_RCLCPP_OPTION(QoS, clock_qos, ClockQoS())
  GAZELLE_RCLCPP_OPTION(bool, use_clock_thread, true)
  GAZELLE_RCLCPP_OPTION(bool, enable_logger_service, false)
  GAZELLE_RCLCPP_OPTION(QoS, parameter_event_qos, ParameterEventsQoS())
  GAZELLE_RCLCPP_OPTION(QoS, rosout_qos, RosoutQoS())
  GAZELLE_RCLCPP_OPTION(PublisherOptionsBase, parameter_event_publisher_options,
                        PublisherOptionsBase())
  GAZELLE_RCLCPP_OPTION(bool, allow_undeclared_parameters, false)
  GAZELLE_RCLCPP_OPTION(bool, automatically_declare_parameters_from_overrides, false)
  GAZELLE_RCLCPP_OPTION(rcl_allocator_t, allocator, rcl_get_default_allocator())
#undef GAZELLE_RCLCPP_OPTION

  std::vector<Parameter>& parameter_overrides() { return overrides_; }
  const std::vector<Parameter>& parameter_overrides() const { return overrides_; }
  NodeOptions& parameter_overrides(const std::vector<Parameter>& overrides) {
    overrides_ = overrides;
    return *this;
  }
  template <typename ParameterT>
  NodeOptions& append_parameter_override(const std::string& name, const ParameterT& value) {
    overrides_.emplace_back(name, ParameterValue(value));
    return *this;
  }

 private:
  std::vector<Parameter> overrides_;
};

}  // namespace rclcpp
