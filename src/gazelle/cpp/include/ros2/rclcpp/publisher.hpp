#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "gazelle/message.hpp"
#include "rclcpp/allocator/allocator_common.hpp"
#include "rclcpp/detail/given_message.hpp"
#include "rclcpp/loaned_message.hpp"
#include "rclcpp/publisher_base.hpp"
#include "rclcpp/type_adapter.hpp"

namespace rclcpp {

/// Sends messages of one type; with a type adapter also those of the user's own class.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class Publisher : public PublisherBase {
 public:
  using PublishedType = typename detail::Adapted<MessageT>::custom_type;
  using ROSMessageType = typename detail::Adapted<MessageT>::ros_type;
  using MessageAllocator = AllocatorT;
  using MessageDeleter = allocator::Deleter<AllocatorT, ROSMessageType>;
  using MessageSharedPtr = std::shared_ptr<const ROSMessageType>;
  RCLCPP_SMART_PTR_DEFINITIONS(Publisher<MessageT, AllocatorT>)

  Publisher(node_interfaces::NodeBaseInterface* node, const std::string& topic, const QoS& qos,
            const PublisherOptionsWithAllocator<AllocatorT>& options)
      : PublisherBase(node, topic, gazelle::message_type<ROSMessageType>(), qos, options),
        allocator_(options.get_allocator()) {}
  virtual void post_init_setup(node_interfaces::NodeBaseInterface*, const std::string&, const QoS&,
                               const PublisherOptionsWithAllocator<AllocatorT>&) {}

  virtual void publish(const ROSMessageType& message) {
    publish_look(&message, &Publisher::copy_of);
  }

  template <typename DeleterT>
  void publish(std::unique_ptr<ROSMessageType, DeleterT> message) {
    if (!message) throw std::runtime_error("cannot publish msg which is a null pointer");
    publish_object(detail::shared_of(std::move(message)));
  }

  template <typename T>
  std::enable_if_t<detail::Adapted<MessageT>::is_adapted && std::is_same<T, PublishedType>::value>
  publish(const T& message) {
    auto made = std::make_unique<ROSMessageType>();
    detail::Adapted<MessageT>::adapter::convert_to_ros_message(message, *made);
    publish_object(detail::shared_of(std::move(made)));
  }

  template <typename T, typename DeleterT>
  std::enable_if_t<detail::Adapted<MessageT>::is_adapted && std::is_same<T, PublishedType>::value>
  publish(std::unique_ptr<T, DeleterT> message) {
    publish(*message);
  }

  void publish(const rcl_serialized_message_t& message) { publish_bytes(message); }
  void publish(const SerializedMessage& message) {
    publish_bytes(message.get_rcl_serialized_message());
  }
  void publish(LoanedMessage<ROSMessageType, AllocatorT>&& message) {
    if (!message.is_valid()) throw std::runtime_error("loaned message is not valid");
    publish(message.release());
  }

  LoanedMessage<ROSMessageType, AllocatorT> borrow_loaned_message() {
    return LoanedMessage<ROSMessageType, AllocatorT>(*this);
  }
  AllocatorT get_allocator() const { return *allocator_; }

 private:
  static std::shared_ptr<const void> copy_of(const void* message) {
    return detail::shared_of(
        std::make_unique<ROSMessageType>(*static_cast<const ROSMessageType*>(message)));
  }
  std::shared_ptr<AllocatorT> allocator_;
};

}  // namespace rclcpp
