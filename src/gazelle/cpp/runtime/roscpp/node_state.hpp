// What the parts of roscpp share: the node of the process and everything it has made.
#pragma once

#include <ros/callback_queue.h>
#include <ros/forwards.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <gazelle/core.hpp>

#include <memory>
#include <string>

namespace ros {
namespace detail {

// A publisher, subscription, service, client or timer of this node.
struct End {
  virtual ~End() = default;
  // Leave the graph; with `waiting`, come back when no callback of it runs any more.
  virtual void close(bool waiting) = 0;
};

// Remember an end, so that the node's end is its own.
void keep(const boost::shared_ptr<End>& end);
void closeAll();

// The node in the graph; null before ros::start() and after ros::shutdown().
std::shared_ptr<gazelle::GraphNode> graphNode();

// Numbers that callback queues know owners by.
uint64_t newOwner();

// Calls a function from a queue, for as long as its owner is there.
CallbackInterfacePtr later(const boost::function<void()>& function,
                           const boost::weak_ptr<void const>& owner);

XmlRpc::XmlRpcValue valueOf(const gazelle::Json& json);
gazelle::Json jsonOf(const XmlRpc::XmlRpcValue& value);

}  // namespace detail

namespace names {
void init(const M_string& remappings);
}
namespace this_node {
void init(const std::string& name, const M_string& remappings, uint32_t options);
}
namespace param {
void init(const M_string& remappings);
}
namespace console {
void offerServices(gazelle::GraphNode& node);
void closeServices();
}  // namespace console

}  // namespace ros
