#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "gazelle/core.hpp"
#include "rcl/handles.h"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/network_flow_endpoint.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class Waitable;
namespace node_interfaces {
class NodeBaseInterface;
}

/// What publishers of all types share.
class RCLCPP_PUBLIC PublisherBase : public std::enable_shared_from_this<PublisherBase> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(PublisherBase)
  /// Of a type that this program knows.
  PublisherBase(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                const gazelle::MessageType& type, const QoS& qos,
                const PublisherOptionsBase& options);
  /// Of a type that it knows by name.
  PublisherBase(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                const std::string& type_name, const QoS& qos, const PublisherOptionsBase& options);
  virtual ~PublisherBase();

  const char* get_topic_name() const;
  std::size_t get_queue_size() const;
  const rmw_gid_t& get_gid() const;
  std::shared_ptr<rcl_publisher_t> get_publisher_handle();
  std::shared_ptr<const rcl_publisher_t> get_publisher_handle() const;
  const std::unordered_map<int, std::shared_ptr<Waitable>>& get_event_handlers() const;
  std::size_t get_subscription_count() const;
  std::size_t get_intra_process_subscription_count() const;
  bool assert_liveliness() const;
  QoS get_actual_qos() const;
  bool can_loan_messages() const { return false; }
  bool operator==(const rmw_gid_t& gid) const;
  bool operator==(const rmw_gid_t* gid) const { return gid && *this == *gid; }
  std::vector<NetworkFlowEndpoint> get_network_flow_endpoints() const { return {}; }
  std::size_t lowest_available_ipm_capacity() const { return get_queue_size(); }
  /// Whether a message would go anywhere.
  bool is_wanted() const;
  template <typename Rep = int64_t, typename Ratio = std::milli>
  bool wait_for_all_acked(
      std::chrono::duration<Rep, Ratio> timeout = std::chrono::duration<Rep, Ratio>(-1)) const {
    (void)timeout;
    // Messages are handed over when publish returns; nobody tells when they were read.
    return true;
  }

 protected:
  void publish_object(std::shared_ptr<const void> message);
  void publish_look(const void* message, std::shared_ptr<const void> (*copy)(const void*));
  void publish_bytes(const rcl_serialized_message_t& message);

 public:
  class Impl;

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace rclcpp
