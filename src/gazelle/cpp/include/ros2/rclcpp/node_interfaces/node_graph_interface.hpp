#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "rclcpp/event.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/visibility_control.hpp"
#include "rmw/topic_endpoint_info.h"

namespace rclcpp {

enum class EndpointType {
  Invalid = RMW_ENDPOINT_INVALID,
  Publisher = RMW_ENDPOINT_PUBLISHER,
  Subscription = RMW_ENDPOINT_SUBSCRIPTION
};

/// A publisher or subscription that somebody has.
class TopicEndpointInfo {
 public:
  TopicEndpointInfo(std::string node_name, std::string node_namespace, std::string topic_type,
                    EndpointType endpoint_type,
                    std::array<uint8_t, RMW_GID_STORAGE_SIZE> endpoint_gid, const QoS& qos)
      : node_name_(std::move(node_name)),
        node_namespace_(std::move(node_namespace)),
        topic_type_(std::move(topic_type)),
        endpoint_type_(endpoint_type),
        endpoint_gid_(endpoint_gid),
        qos_profile_(qos) {}

  std::string& node_name() { return node_name_; }
  const std::string& node_name() const { return node_name_; }
  std::string& node_namespace() { return node_namespace_; }
  const std::string& node_namespace() const { return node_namespace_; }
  std::string& topic_type() { return topic_type_; }
  const std::string& topic_type() const { return topic_type_; }
  rclcpp::EndpointType& endpoint_type() { return endpoint_type_; }
  const rclcpp::EndpointType& endpoint_type() const { return endpoint_type_; }
  std::array<uint8_t, RMW_GID_STORAGE_SIZE>& endpoint_gid() { return endpoint_gid_; }
  const std::array<uint8_t, RMW_GID_STORAGE_SIZE>& endpoint_gid() const { return endpoint_gid_; }
  QoS& qos_profile() { return qos_profile_; }
  const QoS& qos_profile() const { return qos_profile_; }

 private:
  std::string node_name_;
  std::string node_namespace_;
  std::string topic_type_;
  rclcpp::EndpointType endpoint_type_;
  std::array<uint8_t, RMW_GID_STORAGE_SIZE> endpoint_gid_;
  QoS qos_profile_;
};

namespace node_interfaces {

/// What a node sees of the graph.
class RCLCPP_PUBLIC NodeGraphInterface {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(NodeGraphInterface)
  using NamesAndTypes = std::map<std::string, std::vector<std::string>>;
  virtual ~NodeGraphInterface() = default;
  virtual NamesAndTypes get_topic_names_and_types(bool no_demangle = false) const = 0;
  virtual NamesAndTypes get_service_names_and_types() const = 0;
  virtual NamesAndTypes get_service_names_and_types_by_node(const std::string& name,
                                                            const std::string& space) const = 0;
  virtual NamesAndTypes get_client_names_and_types_by_node(const std::string& name,
                                                           const std::string& space) const = 0;
  virtual NamesAndTypes get_publisher_names_and_types_by_node(const std::string& name,
                                                              const std::string& space,
                                                              bool no_demangle = false) const = 0;
  virtual NamesAndTypes get_subscriber_names_and_types_by_node(const std::string& name,
                                                               const std::string& space,
                                                               bool no_demangle = false) const = 0;
  virtual std::vector<std::string> get_node_names() const = 0;
  virtual std::vector<std::tuple<std::string, std::string, std::string>>
  get_node_names_with_enclaves() const = 0;
  virtual std::vector<std::pair<std::string, std::string>> get_node_names_and_namespaces()
      const = 0;
  virtual std::size_t count_publishers(const std::string& topic) const = 0;
  virtual std::size_t count_subscribers(const std::string& topic) const = 0;
  virtual std::size_t count_clients(const std::string& service) const = 0;
  virtual std::size_t count_services(const std::string& service) const = 0;
  virtual void notify_graph_change() = 0;
  virtual Event::SharedPtr get_graph_event() = 0;
  virtual void wait_for_graph_change(Event::SharedPtr event, std::chrono::nanoseconds timeout) = 0;
  virtual std::size_t count_graph_users() const = 0;
  virtual std::vector<TopicEndpointInfo> get_publishers_info_by_topic(
      const std::string& topic, bool no_mangle = false) const = 0;
  virtual std::vector<TopicEndpointInfo> get_subscriptions_info_by_topic(
      const std::string& topic, bool no_mangle = false) const = 0;
};

}  // namespace node_interfaces
}  // namespace rclcpp
