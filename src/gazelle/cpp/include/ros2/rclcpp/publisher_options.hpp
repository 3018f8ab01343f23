#pragma once

#include <memory>
#include <string>

#include "rclcpp/callback_group.hpp"
#include "rclcpp/detail/endpoint_options.hpp"
#include "rclcpp/qos_overriding_options.hpp"
#include "rmw/types.h"

namespace rclcpp {

/// What a publisher is told besides topic and QoS.
struct PublisherOptionsBase {
  IntraProcessSetting use_intra_process_comm = IntraProcessSetting::NodeDefault;
  IntraProcessBufferType intra_process_buffer_type = IntraProcessBufferType::CallbackDefault;
  PublisherEventCallbacks event_callbacks;
  bool use_default_callbacks = true;
  rmw_unique_network_flow_endpoints_requirement_t require_unique_network_flow_endpoints =
      RMW_UNIQUE_NETWORK_FLOW_ENDPOINTS_NOT_REQUIRED;
  std::shared_ptr<CallbackGroup> callback_group;
  std::shared_ptr<void> rmw_implementation_payload;
  QosOverridingOptions qos_overriding_options;
};

template <typename Allocator = std::allocator<void>>
struct PublisherOptionsWithAllocator : public PublisherOptionsBase {
  std::shared_ptr<Allocator> allocator;
  PublisherOptionsWithAllocator() = default;
  explicit PublisherOptionsWithAllocator(const PublisherOptionsBase& base)
      : PublisherOptionsBase(base) {}
  std::shared_ptr<Allocator> get_allocator() const {
    return allocator ? allocator : std::make_shared<Allocator>();
  }
};

using PublisherOptions = PublisherOptionsWithAllocator<std::allocator<void>>;

}  // namespace rclcpp
