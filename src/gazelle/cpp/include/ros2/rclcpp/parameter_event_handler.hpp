#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "rcl_interfaces/msg/parameter_event.hpp"
#include "rclcpp/create_subscription.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/parameter.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/subscription.hpp"

namespace rclcpp {

struct ParameterCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(ParameterCallbackHandle)
  using ParameterCallbackType = std::function<void(const Parameter&)>;
  std::string parameter_name;
  std::string node_name;
  ParameterCallbackType callback;
};

struct ParameterEventCallbackHandle {
  RCLCPP_SMART_PTR_DEFINITIONS(ParameterEventCallbackHandle)
  using ParameterEventCallbackType =
      std::function<void(const rcl_interfaces::msg::ParameterEvent&)>;
  ParameterEventCallbackType callback;
};

/// Calls functions when parameters of nodes change; the handles keep them alive.
class RCLCPP_PUBLIC ParameterEventHandler {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(ParameterEventHandler)
  using ParameterCallbackType = ParameterCallbackHandle::ParameterCallbackType;
  using ParameterEventCallbackType = ParameterEventCallbackHandle::ParameterEventCallbackType;

  template <typename NodeT>
  explicit ParameterEventHandler(
      NodeT node,
      const QoS& qos = QoS(QoSInitialization::from_rmw(rmw_qos_profile_parameter_events),
                           rmw_qos_profile_parameter_events))
      : base_(node_interfaces::get_node_base_interface(node)),
        callbacks_(std::make_shared<Callbacks>()) {
    auto callbacks = callbacks_;
    subscription_ = create_subscription<rcl_interfaces::msg::ParameterEvent>(
        node_interfaces::get_node_topics_interface(node), "/parameter_events", qos,
        [callbacks](const rcl_interfaces::msg::ParameterEvent& event) { callbacks->hear(event); });
  }

  ParameterEventCallbackHandle::SharedPtr add_parameter_event_callback(
      ParameterEventCallbackType callback);
  void remove_parameter_event_callback(ParameterEventCallbackHandle::SharedPtr handle);
  ParameterCallbackHandle::SharedPtr add_parameter_callback(const std::string& parameter_name,
                                                            ParameterCallbackType callback,
                                                            const std::string& node_name = "");
  void remove_parameter_callback(ParameterCallbackHandle::SharedPtr handle);

  static bool get_parameter_from_event(const rcl_interfaces::msg::ParameterEvent& event,
                                       Parameter& parameter, const std::string& parameter_name,
                                       const std::string& node_name = "");
  static Parameter get_parameter_from_event(const rcl_interfaces::msg::ParameterEvent& event,
                                            const std::string& parameter_name,
                                            const std::string& node_name = "");
  static std::vector<Parameter> get_parameters_from_event(
      const rcl_interfaces::msg::ParameterEvent& event);

 protected:
  struct RCLCPP_PUBLIC Callbacks {
    std::recursive_mutex mutex;
    std::list<ParameterCallbackHandle::WeakPtr> parameters;
    std::list<ParameterEventCallbackHandle::WeakPtr> events;
    void hear(const rcl_interfaces::msg::ParameterEvent& event);
  };
  std::string resolve_path(const std::string& path) const;

  node_interfaces::NodeBaseInterface::SharedPtr base_;
  std::shared_ptr<Callbacks> callbacks_;
  Subscription<rcl_interfaces::msg::ParameterEvent>::SharedPtr subscription_;
};

using ParameterEventCallbackType = ParameterEventHandler::ParameterEventCallbackType;

}  // namespace rclcpp
