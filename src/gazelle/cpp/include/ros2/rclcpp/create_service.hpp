#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"
#include "rclcpp/service.hpp"

namespace rclcpp {

template <typename ServiceT, typename CallbackT>
typename Service<ServiceT>::SharedPtr create_service(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node,
    std::shared_ptr<node_interfaces::NodeServicesInterface> services, const std::string& name,
    CallbackT&& callback, const QoS& qos, CallbackGroup::SharedPtr group) {
  auto made =
      std::make_shared<Service<ServiceT>>(node.get(), name, std::forward<CallbackT>(callback), qos);
  services->add_service(made, group);
  return made;
}

template <typename ServiceT, typename CallbackT>
typename Service<ServiceT>::SharedPtr create_service(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node,
    std::shared_ptr<node_interfaces::NodeServicesInterface> services, const std::string& name,
    CallbackT&& callback, const rmw_qos_profile_t& profile, CallbackGroup::SharedPtr group) {
  return create_service<ServiceT>(node, services, name, std::forward<CallbackT>(callback),
                                  QoS(QoSInitialization::from_rmw(profile), profile), group);
}

}  // namespace rclcpp
