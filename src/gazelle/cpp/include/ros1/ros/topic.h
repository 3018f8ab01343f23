#pragma once

#include <ros/common.h>
#include <ros/node_handle.h>

#include <boost/shared_ptr.hpp>

namespace ros {
namespace topic {

/// Spins a queue of its own until a message has come, the time is over or the node ends.
ROSCPP_DECL void waitForMessageImpl(SubscribeOptions& options,
                                    const boost::function<bool(void)>& ready, NodeHandle& node,
                                    ros::Duration timeout);

template <class M>
class SubscribeHelper {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  void callback(const MConstPtr& message) { message_ = message; }
  bool hasMessage() { return static_cast<bool>(message_); }
  MConstPtr getMessage() { return message_; }

 private:
  MConstPtr message_;
};

template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic, ros::NodeHandle& node,
                                          ros::Duration timeout) {
  SubscribeHelper<M> helper;
  SubscribeOptions options;
  options.template init<M>(
      topic, 1, [&helper](const boost::shared_ptr<M const>& message) { helper.callback(message); });
  waitForMessageImpl(
      options, [&helper] { return helper.hasMessage(); }, node, timeout);
  return helper.getMessage();
}

template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic) {
  ros::NodeHandle node;
  return waitForMessage<M>(topic, node, ros::Duration());
}

template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic, ros::Duration timeout) {
  ros::NodeHandle node;
  return waitForMessage<M>(topic, node, timeout);
}

template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic, ros::NodeHandle& node) {
  return waitForMessage<M>(topic, node, ros::Duration());
}

}  // namespace topic
}  // namespace ros
