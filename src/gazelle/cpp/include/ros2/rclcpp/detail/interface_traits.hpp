#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/detail/interface_of.hpp"

namespace rclcpp {
namespace node_interfaces {

// Whether a class has the getter of an interface of nodes.
#define GAZELLE_RCLCPP_TRAIT(interface, Interface)                                              \
  template <typename T, typename = void>                                                        \
  struct has_##interface : std::false_type {};                                                  \
  template <typename T>                                                                         \
  struct has_##interface<                                                                       \
      T, std::enable_if_t<std::is_same<std::shared_ptr<Interface>,                              \
                                       decltype(std::declval<T&>().get_##interface())>::value>> \
      : std::true_type {};
GAZELLE_RCLCPP_TRAIT(node_base_interface, NodeBaseInterface)
GAZELLE_RCLCPP_TRAIT(node_clock_interface, NodeClockInterface)
GAZELLE_RCLCPP_TRAIT(node_graph_interface, NodeGraphInterface)
GAZELLE_RCLCPP_TRAIT(node_logging_interface, NodeLoggingInterface)
GAZELLE_RCLCPP_TRAIT(node_parameters_interface, NodeParametersInterface)
GAZELLE_RCLCPP_TRAIT(node_services_interface, NodeServicesInterface)
GAZELLE_RCLCPP_TRAIT(node_time_source_interface, NodeTimeSourceInterface)
GAZELLE_RCLCPP_TRAIT(node_timers_interface, NodeTimersInterface)
GAZELLE_RCLCPP_TRAIT(node_topics_interface, NodeTopicsInterface)
GAZELLE_RCLCPP_TRAIT(node_type_descriptions_interface, NodeTypeDescriptionsInterface)
GAZELLE_RCLCPP_TRAIT(node_waitables_interface, NodeWaitablesInterface)
#undef GAZELLE_RCLCPP_TRAIT

}  // namespace node_interfaces
}  // namespace rclcpp
