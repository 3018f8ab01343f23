#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_clock_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_logging_interface.hpp"
#include "rclcpp/node_interfaces/node_parameters_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/node_interfaces/node_time_source_interface.hpp"
#include "rclcpp/node_interfaces/node_timers_interface.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/node_interfaces/node_type_descriptions_interface.hpp"
#include "rclcpp/node_interfaces/node_waitables_interface.hpp"

namespace rclcpp {
namespace node_interfaces {

// Free functions that ask a node, a pointer to one, or the interface itself.
#define GAZELLE_RCLCPP_INTERFACE_OF(Interface, getter)                    \
  template <typename NodeT>                                               \
  std::shared_ptr<Interface> getter(NodeT&& node) {                       \
    using T = std::remove_cv_t<std::remove_reference_t<NodeT>>;           \
    if constexpr (std::is_convertible_v<T, std::shared_ptr<Interface>>) { \
      return node;                                                        \
    } else if constexpr (requires_arrow<T>::value) {                      \
      return node->getter();                                              \
    } else {                                                              \
      return node.getter();                                               \
    }                                                                     \
  }

template <typename T, typename = void>
struct requires_arrow : std::is_pointer<T> {};
template <typename T>
struct requires_arrow<T, std::void_t<decltype(std::declval<T&>().operator->())>> : std::true_type {
};

GAZELLE_RCLCPP_INTERFACE_OF(NodeBaseInterface, get_node_base_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeClockInterface, get_node_clock_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeGraphInterface, get_node_graph_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeLoggingInterface, get_node_logging_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeParametersInterface, get_node_parameters_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeServicesInterface, get_node_services_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeTimersInterface, get_node_timers_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeTopicsInterface, get_node_topics_interface)
GAZELLE_RCLCPP_INTERFACE_OF(NodeWaitablesInterface, get_node_waitables_interface)
#undef GAZELLE_RCLCPP_INTERFACE_OF

}  // namespace node_interfaces
}  // namespace rclcpp
