#pragma once

#include <memory>
#include <string>
#include <utility>

#include "rclcpp/logging.hpp"
#include "rclcpp/publisher.hpp"
#include "rclcpp_lifecycle/managed_entity.hpp"

namespace rclcpp_lifecycle {

/// A publisher that is silent until its node is active.
template <typename MessageT, typename Alloc = std::allocator<void>>
class LifecyclePublisher : public SimpleManagedEntity, public rclcpp::Publisher<MessageT, Alloc> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(LifecyclePublisher)
  using Base = rclcpp::Publisher<MessageT, Alloc>;

  LifecyclePublisher(rclcpp::node_interfaces::NodeBaseInterface* node, const std::string& topic,
                     const rclcpp::QoS& qos,
                     const rclcpp::PublisherOptionsWithAllocator<Alloc>& options)
      : Base(node, topic, qos, options), logger_(rclcpp::get_logger("LifecyclePublisher")) {}

  void publish(const typename Base::ROSMessageType& message) override {
    if (may_publish()) Base::publish(message);
  }
  template <typename T>
  void publish(T&& message) {
    if (may_publish()) Base::publish(std::forward<T>(message));
  }
  void on_activate() override {
    SimpleManagedEntity::on_activate();
    should_log_ = true;
  }

 private:
  bool may_publish() {
    if (this->is_activated()) return true;
    if (should_log_) {
      RCLCPP_WARN(logger_,
                  "Trying to publish message on the topic '%s', but the publisher is not activated",
                  this->get_topic_name());
      should_log_ = false;
    }
    return false;
  }
  bool should_log_ = true;
  rclcpp::Logger logger_;
};

}  // namespace rclcpp_lifecycle
