#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
namespace master {

/// A topic that somebody publishes.
struct ROSCPP_DECL TopicInfo {
  TopicInfo() {}
  TopicInfo(const std::string& name_, const std::string& datatype_)
      : name(name_), datatype(datatype_) {}
  std::string name;
  std::string datatype;
};
typedef std::vector<TopicInfo> V_TopicInfo;

/// Answers the master's calls that only look: getPublishedTopics, getTopicTypes, getSystemState,
/// lookupNode, lookupService, getUri, getPid.
ROSCPP_DECL bool execute(const std::string& method, const XmlRpc::XmlRpcValue& request,
                         XmlRpc::XmlRpcValue& response, XmlRpc::XmlRpcValue& payload,
                         bool wait_for_master);
ROSCPP_DECL const std::string& getHost();
ROSCPP_DECL uint32_t getPort();
ROSCPP_DECL const std::string& getURI();
ROSCPP_DECL bool check();
ROSCPP_DECL bool getTopics(V_TopicInfo& topics);
ROSCPP_DECL bool getNodes(V_string& nodes);
ROSCPP_DECL void setRetryTimeout(ros::WallDuration timeout);

}  // namespace master
}  // namespace ros
