#pragma once

#include <memory>
#include <string>

#include "rclcpp/client.hpp"
#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/node_interfaces/node_graph_interface.hpp"
#include "rclcpp/node_interfaces/node_services_interface.hpp"

namespace rclcpp {

template <typename ServiceT>
typename Client<ServiceT>::SharedPtr create_client(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node,
    std::shared_ptr<node_interfaces::NodeGraphInterface> graph,
    std::shared_ptr<node_interfaces::NodeServicesInterface> services, const std::string& name,
    const QoS& qos = ServicesQoS(), CallbackGroup::SharedPtr group = nullptr) {
  (void)graph;
  auto made = std::make_shared<Client<ServiceT>>(node.get(), name, qos);
  services->add_client(made, group);
  return made;
}

template <typename ServiceT>
typename Client<ServiceT>::SharedPtr create_client(
    std::shared_ptr<node_interfaces::NodeBaseInterface> node,
    std::shared_ptr<node_interfaces::NodeGraphInterface> graph,
    std::shared_ptr<node_interfaces::NodeServicesInterface> services, const std::string& name,
    const rmw_qos_profile_t& profile, CallbackGroup::SharedPtr group) {
  return create_client<ServiceT>(node, graph, services, name,
                                 QoS(QoSInitialization::from_rmw(profile), profile), group);
}

}  // namespace rclcpp
