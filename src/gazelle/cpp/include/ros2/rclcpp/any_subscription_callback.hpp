#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include "gazelle/message.hpp"
#include "rclcpp/detail/given_message.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/serialized_message.hpp"
#include "rclcpp/subscription_base.hpp"
#include "rclcpp/type_adapter.hpp"

namespace rclcpp {
namespace detail {

template <class F, class Argument>
constexpr bool takes = std::is_invocable_v<F&, Argument>;
template <class F, class Argument>
constexpr bool takes_with_info = std::is_invocable_v<F&, Argument, const MessageInfo&>;
template <class F, class Argument>
constexpr bool takes_either = takes<F, Argument> || takes_with_info<F, Argument>;

template <class F, class Argument>
void call_with(F& function, Argument&& argument, const MessageInfo& info) {
  if constexpr (takes<F, Argument>) {
    (void)info;
    function(std::forward<Argument>(argument));
  } else {
    function(std::forward<Argument>(argument), info);
  }
}

/// An object that nobody else has.
template <class M>
std::unique_ptr<M> own_message(gazelle::Delivered&& delivered) {
  std::shared_ptr<const void> message = delivered.object(gazelle::message_type<M>());
  { gazelle::Delivered gone = std::move(delivered); }
  return unique_of<M>(std::move(message));
}

inline std::shared_ptr<SerializedMessage> bytes_message(const gazelle::Delivered& delivered) {
  const gazelle::Bytes bytes = delivered.cdr();
  auto made = std::make_shared<SerializedMessage>();
  made->assign(bytes.data(), bytes.size());
  return made;
}

template <class F>
constexpr bool wants_bytes = takes_either<F, const SerializedMessage&> ||
                             takes_either<F, std::shared_ptr<const SerializedMessage>> ||
                             takes_either<F, std::shared_ptr<SerializedMessage>> ||
                             takes_either<F, std::unique_ptr<SerializedMessage>>;

// The order matters: a function of a shared pointer could also be called with a unique one.
/// Wrap a user's function, whatever it takes, for a topic that was declared with `MessageT`.
template <class MessageT, class F>
MessageCallback make_message_callback(F&& function) {
  using Callable = std::decay_t<F>;
  using Ros = typename Adapted<MessageT>::ros_type;
  using Custom = typename Adapted<MessageT>::custom_type;
  // Kept behind a pointer: functions that hold what cannot be copied are allowed as well.
  auto kept = std::make_shared<Callable>(std::forward<F>(function));
  return [kept](gazelle::Delivered&& delivered, const MessageInfo& info) {
    Callable& call = *kept;
    if constexpr (Adapted<MessageT>::is_adapted && takes_either<Callable, const Custom&>) {
      auto ros = delivered.as<Ros>(gazelle::message_type<Ros>());
      call_with<Callable, const Custom&>(call, *to_custom<MessageT>(*ros), info);
    } else if constexpr (Adapted<MessageT>::is_adapted &&
                         takes_either<Callable, std::shared_ptr<const Custom>>) {
      auto ros = delivered.as<Ros>(gazelle::message_type<Ros>());
      call_with(call, std::shared_ptr<const Custom>(to_custom<MessageT>(*ros)), info);
    } else if constexpr (Adapted<MessageT>::is_adapted &&
                         takes_either<Callable, std::shared_ptr<Custom>>) {
      auto ros = delivered.as<Ros>(gazelle::message_type<Ros>());
      call_with(call, std::shared_ptr<Custom>(to_custom<MessageT>(*ros)), info);
    } else if constexpr (Adapted<MessageT>::is_adapted &&
                         takes_either<Callable, std::unique_ptr<Custom>>) {
      auto ros = delivered.as<Ros>(gazelle::message_type<Ros>());
      call_with(call, to_custom<MessageT>(*ros), info);
    } else if constexpr (takes_either<Callable, const Ros&>) {
      auto message = delivered.as<Ros>(gazelle::message_type<Ros>());
      call_with<Callable, const Ros&>(call, *message, info);
    } else if constexpr (takes_either<Callable, std::shared_ptr<const Ros>>) {
      call_with(call, delivered.as<Ros>(gazelle::message_type<Ros>()), info);
    } else if constexpr (takes_either<Callable, std::shared_ptr<Ros>>) {
      call_with(call, std::shared_ptr<Ros>(own_message<Ros>(std::move(delivered))), info);
    } else if constexpr (takes_either<Callable, std::unique_ptr<Ros>>) {
      call_with(call, own_message<Ros>(std::move(delivered)), info);
    } else if constexpr (takes_either<Callable, const SerializedMessage&>) {
      call_with<Callable, const SerializedMessage&>(call, *bytes_message(delivered), info);
    } else if constexpr (takes_either<Callable, std::shared_ptr<const SerializedMessage>>) {
      call_with(call, std::shared_ptr<const SerializedMessage>(bytes_message(delivered)), info);
    } else if constexpr (takes_either<Callable, std::shared_ptr<SerializedMessage>>) {
      call_with(call, bytes_message(delivered), info);
    } else if constexpr (takes_either<Callable, std::unique_ptr<SerializedMessage>>) {
      call_with(call, std::make_unique<SerializedMessage>(*bytes_message(delivered)), info);
    } else {
      static_assert(takes_either<Callable, const Ros&>,
                    "a subscription's callback takes the message as const reference, shared_ptr, "
                    "unique_ptr or SerializedMessage, and may take a MessageInfo after it");
    }
  };
}

}  // namespace detail

/// A function for messages in whatever form it takes them.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class AnySubscriptionCallback {
 public:
  explicit AnySubscriptionCallback(const AllocatorT& = AllocatorT()) {}
  template <typename CallbackT>
  AnySubscriptionCallback set(CallbackT&& callback) {
    serialized_ = detail::wants_bytes<std::decay_t<CallbackT>>;
    callback_ = detail::make_message_callback<MessageT>(std::forward<CallbackT>(callback));
    return *this;
  }
  bool is_serialized_message_callback() const { return serialized_; }
  const detail::MessageCallback& get() const { return callback_; }

 private:
  detail::MessageCallback callback_;
  bool serialized_ = false;
};

}  // namespace rclcpp
