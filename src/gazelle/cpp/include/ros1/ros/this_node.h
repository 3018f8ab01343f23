#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

namespace ros {
namespace this_node {

ROSCPP_DECL const std::string& getName();
ROSCPP_DECL const std::string& getNamespace();
ROSCPP_DECL void getAdvertisedTopics(V_string& topics);
ROSCPP_DECL void getSubscribedTopics(V_string& topics);

}  // namespace this_node
}  // namespace ros
