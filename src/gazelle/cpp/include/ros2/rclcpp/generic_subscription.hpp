#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/subscription_base.hpp"

namespace rclcpp {

/// Receives messages, as CDR, of a type that is named when the program runs.
class RCLCPP_PUBLIC GenericSubscription : public SubscriptionBase {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(GenericSubscription)
  GenericSubscription(node_interfaces::NodeBaseInterface* node, const std::string& topic,
                      const std::string& type, const QoS& qos,
                      const SubscriptionOptionsBase& options, detail::MessageCallback callback)
      : SubscriptionBase(node, topic, type, qos, options, std::move(callback)) {
    serialized_ = true;
  }
};

namespace detail {

template <class F>
MessageCallback make_bytes_callback(F&& function) {
  using Callable = std::decay_t<F>;
  auto kept = std::make_shared<Callable>(std::forward<F>(function));
  return [kept](gazelle::Delivered&& delivered, const MessageInfo& info) {
    Callable& call = *kept;
    if constexpr (takes_either<Callable, const SerializedMessage&>) {
      call_with<Callable, const SerializedMessage&>(call, *bytes_message(delivered), info);
    } else if constexpr (takes_either<Callable, std::shared_ptr<const SerializedMessage>>) {
      call_with(call, std::shared_ptr<const SerializedMessage>(bytes_message(delivered)), info);
    } else if constexpr (takes_either<Callable, std::shared_ptr<SerializedMessage>>) {
      call_with(call, bytes_message(delivered), info);
    } else {
      call_with(call, std::make_unique<SerializedMessage>(*bytes_message(delivered)), info);
    }
  };
}

}  // namespace detail

template <typename CallbackT, typename AllocatorT = std::allocator<void>>
std::shared_ptr<GenericSubscription> create_generic_subscription(
    node_interfaces::NodeTopicsInterface::SharedPtr topics, const std::string& topic,
    const std::string& type, const QoS& qos, CallbackT&& callback,
    const SubscriptionOptionsWithAllocator<AllocatorT>& options =
        SubscriptionOptionsWithAllocator<AllocatorT>()) {
  auto made = std::make_shared<GenericSubscription>(
      topics->get_node_base_interface(), topic, type, qos, options,
      detail::make_bytes_callback(std::forward<CallbackT>(callback)));
  topics->add_subscription(made, options.callback_group);
  return made;
}

}  // namespace rclcpp
