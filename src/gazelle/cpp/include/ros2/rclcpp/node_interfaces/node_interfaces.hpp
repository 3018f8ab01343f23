#pragma once

#include <memory>
#include <tuple>
#include <type_traits>

#include "rclcpp/detail/interface_of.hpp"

namespace rclcpp {
namespace node_interfaces {

namespace detail {

template <typename Interface>
struct Getter;
#define GAZELLE_RCLCPP_GETTER(Interface, getter)        \
  template <>                                           \
  struct Getter<Interface> {                            \
    template <typename NodeT>                           \
    static std::shared_ptr<Interface> of(NodeT& node) { \
      return node.getter();                             \
    }                                                   \
  };
GAZELLE_RCLCPP_GETTER(NodeBaseInterface, get_node_base_interface)
GAZELLE_RCLCPP_GETTER(NodeClockInterface, get_node_clock_interface)
GAZELLE_RCLCPP_GETTER(NodeGraphInterface, get_node_graph_interface)
GAZELLE_RCLCPP_GETTER(NodeLoggingInterface, get_node_logging_interface)
GAZELLE_RCLCPP_GETTER(NodeParametersInterface, get_node_parameters_interface)
GAZELLE_RCLCPP_GETTER(NodeServicesInterface, get_node_services_interface)
GAZELLE_RCLCPP_GETTER(NodeTimeSourceInterface, get_node_time_source_interface)
GAZELLE_RCLCPP_GETTER(NodeTimersInterface, get_node_timers_interface)
GAZELLE_RCLCPP_GETTER(NodeTopicsInterface, get_node_topics_interface)
GAZELLE_RCLCPP_GETTER(NodeTypeDescriptionsInterface, get_node_type_descriptions_interface)
GAZELLE_RCLCPP_GETTER(NodeWaitablesInterface, get_node_waitables_interface)
#undef GAZELLE_RCLCPP_GETTER

}  // namespace detail

/// Some of the interfaces of a node, whichever class the node is of.
template <typename... Interfaces>
class NodeInterfaces {
 public:
  template <typename NodeT>
  NodeInterfaces(NodeT& node)  // NOLINT(runtime/explicit)
      : interfaces_(detail::Getter<Interfaces>::of(node)...) {}
  explicit NodeInterfaces(std::shared_ptr<Interfaces>... interfaces) : interfaces_(interfaces...) {}

  template <typename Interface>
  std::shared_ptr<Interface> get() {
    return std::get<std::shared_ptr<Interface>>(interfaces_);
  }
  template <typename Interface>
  std::shared_ptr<const Interface> get() const {
    return std::get<std::shared_ptr<Interface>>(interfaces_);
  }
#define GAZELLE_RCLCPP_NAMED(Interface, getter)       \
  template <typename I = Interface>                   \
  std::shared_ptr<I> getter() const {                 \
    return std::get<std::shared_ptr<I>>(interfaces_); \
  }
  GAZELLE_RCLCPP_NAMED(NodeBaseInterface, get_node_base_interface)
  GAZELLE_RCLCPP_NAMED(NodeClockInterface, get_node_clock_interface)
  GAZELLE_RCLCPP_NAMED(NodeGraphInterface, get_node_graph_interface)
  GAZELLE_RCLCPP_NAMED(NodeLoggingInterface, get_node_logging_interface)
  GAZELLE_RCLCPP_NAMED(NodeParametersInterface, get_node_parameters_interface)
  GAZELLE_RCLCPP_NAMED(NodeServicesInterface, get_node_services_interface)
  GAZELLE_RCLCPP_NAMED(NodeTimeSourceInterface, get_node_time_source_interface)
  GAZELLE_RCLCPP_NAMED(NodeTimersInterface, get_node_timers_interface)
  GAZELLE_RCLCPP_NAMED(NodeTopicsInterface, get_node_topics_interface)
  GAZELLE_RCLCPP_NAMED(NodeTypeDescriptionsInterface, get_node_type_descriptions_interface)
  GAZELLE_RCLCPP_NAMED(NodeWaitablesInterface, get_node_waitables_interface)
#undef GAZELLE_RCLCPP_NAMED

 private:
  std::tuple<std::shared_ptr<Interfaces>...> interfaces_;
};

}  // namespace node_interfaces
}  // namespace rclcpp
