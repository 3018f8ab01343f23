#pragma once

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "gazelle/core.hpp"
#include "rcl/handles.h"
#include "rclcpp/detail/executable.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/network_flow_endpoint.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/subscription_options.hpp"
#include "rclcpp/visibility_control.hpp"

namespace rclcpp {

class Waitable;
namespace node_interfaces {
class NodeBaseInterface;
class NodeTopicsInterface;
}  // namespace node_interfaces

enum class DeliveredMessageKind : uint8_t {
  INVALID = 0,
  ROS_MESSAGE = 1,
  SERIALIZED_MESSAGE = 2,
  DYNAMIC_MESSAGE = 3
};

namespace detail {
/// How a message reaches the user's function.
using MessageCallback = std::function<void(gazelle::Delivered&&, const MessageInfo&)>;
}  // namespace detail

/// What subscriptions of all types share: a queue, and what happens to what comes out of it.
class RCLCPP_PUBLIC SubscriptionBase : public detail::Executable,
                                       public std::enable_shared_from_this<SubscriptionBase> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS_NOT_COPYABLE(SubscriptionBase)
  SubscriptionBase(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                   const gazelle::MessageType& type, const QoS& qos,
                   const SubscriptionOptionsBase& options, detail::MessageCallback callback);
  SubscriptionBase(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                   const std::string& type_name, const QoS& qos,
                   const SubscriptionOptionsBase& options, detail::MessageCallback callback);
  ~SubscriptionBase() override;

  const char* get_topic_name() const;
  std::shared_ptr<rcl_subscription_t> get_subscription_handle();
  std::shared_ptr<const rcl_subscription_t> get_subscription_handle() const;
  const std::unordered_map<int, std::shared_ptr<Waitable>>& get_event_handlers() const;
  QoS get_actual_qos() const;
  std::size_t get_publisher_count() const;
  std::vector<NetworkFlowEndpoint> get_network_flow_endpoints() const { return {}; }
  bool can_loan_messages() const { return false; }
  bool is_serialized() const { return serialized_; }
  DeliveredMessageKind get_delivered_message_kind() const {
    return serialized_ ? DeliveredMessageKind::SERIALIZED_MESSAGE
                       : DeliveredMessageKind::ROS_MESSAGE;
  }
  const gazelle::MessageType* get_message_type() const { return type_; }
  bool use_intra_process() const { return false; }
  std::shared_ptr<Waitable> get_intra_process_waitable() const { return nullptr; }

  /// Take the oldest message out of the queue; false where it is empty.
  bool take_type_erased(void* message, MessageInfo& info);
  bool take_serialized(SerializedMessage& message, MessageInfo& info);
  /// Hand a message that was taken to the callback.
  void handle_message(std::shared_ptr<void>& message, const MessageInfo& info);
  void handle_serialized_message(const std::shared_ptr<SerializedMessage>& message,
                                 const MessageInfo& info);
  virtual std::shared_ptr<void> create_message();
  std::shared_ptr<SerializedMessage> create_serialized_message() {
    return std::make_shared<SerializedMessage>();
  }
  virtual void return_message(std::shared_ptr<void>& message) { message.reset(); }
  void return_serialized_message(std::shared_ptr<SerializedMessage>& message) { message.reset(); }

  void set_on_new_message_callback(std::function<void(std::size_t)> callback) {
    set_on_new_work(std::move(callback));
  }
  void clear_on_new_message_callback() { set_on_new_work(nullptr); }
  bool is_cft_enabled() const;
  void set_content_filter(const std::string& expression,
                          const std::vector<std::string>& parameters = {});
  ContentFilterOptions get_content_filter() const;
  const std::string& get_message_type_name() const { return type_name_; }

  detail::WorkKind kind() const override { return detail::WorkKind::kSubscription; }
  bool has_work() override;
  bool do_work() override;

  class Impl;
  /// What a subscription measures of its messages, where it was asked to (topic statistics).
  void start_statistics(node_interfaces::NodeTopicsInterface* topics,
                        const SubscriptionOptionsBase& options, bool by_default);

 protected:
  virtual void assign_message(void* target, std::shared_ptr<void> source);
  bool serialized_ = false;

 private:
  std::shared_ptr<Impl> impl_;
  const gazelle::MessageType* type_ = nullptr;
  std::string type_name_;
};

}  // namespace rclcpp
