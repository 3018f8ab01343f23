#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/any_subscription_callback.hpp"
#include "rclcpp/message_memory_strategy.hpp"
#include "rclcpp/subscription_base.hpp"

namespace rclcpp {

/// Receives messages of one type.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename SubscribedT = typename detail::Adapted<MessageT>::custom_type,
          typename ROSMessageT = typename detail::Adapted<MessageT>::ros_type,
          typename MessageMemoryStrategyT =
              message_memory_strategy::MessageMemoryStrategy<ROSMessageT, AllocatorT>>
class Subscription : public SubscriptionBase {
 public:
  using SubscribedType = SubscribedT;
  using ROSMessageType = ROSMessageT;
  using MessageMemoryStrategyType = MessageMemoryStrategyT;
  RCLCPP_SMART_PTR_DEFINITIONS(Subscription)

  template <typename CallbackT>
  Subscription(node_interfaces::NodeBaseInterface* node, const std::string& topic, const QoS& qos,
               CallbackT&& callback, const SubscriptionOptionsBase& options)
      : SubscriptionBase(
            node, topic, gazelle::message_type<ROSMessageT>(), qos, options,
            detail::make_message_callback<MessageT>(std::forward<CallbackT>(callback))) {
    serialized_ = detail::wants_bytes<std::decay_t<CallbackT>>;
  }

  /// Take the oldest message out of the queue.
  bool take(ROSMessageType& message, MessageInfo& info) { return take_type_erased(&message, info); }
  template <typename T>
  std::enable_if_t<!std::is_same<ROSMessageType, SubscribedType>::value &&
                       std::is_same<T, SubscribedType>::value,
                   bool>
  take(T& message, MessageInfo& info) {
    ROSMessageType ros;
    if (!take_type_erased(&ros, info)) return false;
    detail::Adapted<MessageT>::adapter::convert_to_custom(ros, message);
    return true;
  }

 protected:
  void assign_message(void* target, std::shared_ptr<void> source) override {
    *static_cast<ROSMessageType*>(target) = std::move(*static_cast<ROSMessageType*>(source.get()));
  }
};

}  // namespace rclcpp
