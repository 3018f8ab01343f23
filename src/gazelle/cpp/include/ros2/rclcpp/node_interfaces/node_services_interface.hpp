#pragma once

#include <memory>
#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/client.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/service.hpp"

namespace rclcpp {
namespace node_interfaces {

/// Services and clients of a node.
class RCLCPP_PUBLIC NodeServicesInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeServicesInterface)
  virtual ~NodeServicesInterface() = default;
  virtual void add_client(ClientBase::SharedPtr client, CallbackGroup::SharedPtr group) = 0;
  virtual void add_service(ServiceBase::SharedPtr service, CallbackGroup::SharedPtr group) = 0;
  virtual std::string resolve_service_name(const std::string& name,
                                           bool only_expand = false) const = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
