// How old messages are and how often they come, published now and then.
#pragma once

#include <memory>

#include "gazelle/core.hpp"
#include "rclcpp/node_interfaces/node_topics_interface.hpp"
#include "rclcpp/subscription_options.hpp"

namespace rclcpp {
namespace detail {

class TopicStatistics {
 public:
  static std::shared_ptr<TopicStatistics> create(node_interfaces::NodeTopicsInterface* topics,
                                                 const SubscriptionOptionsBase& options);
  virtual ~TopicStatistics() = default;
  /// Note a message that is handed to its callback.
  virtual void take(const gazelle::Delivered& delivered, const gazelle::MessageType* type) = 0;
};

}  // namespace detail
}  // namespace rclcpp
