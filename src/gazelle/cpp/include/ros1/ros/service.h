#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/names.h>
#include <ros/node_handle.h>
#include <ros/service_client.h>
#include <ros/service_traits.h>

#include <string>

namespace ros {

class ServiceServerLink;
typedef boost::shared_ptr<ServiceServerLink> ServiceServerLinkPtr;

namespace service {

template <class MReq, class MRes>
bool call(const std::string& service_name, MReq& request, MRes& response) {
  NodeHandle node;
  ServiceClientOptions options;
  options.init<MReq, MRes>(names::resolve(service_name), false, M_string());
  return node.serviceClient(options).call(request, response);
}

template <class Service>
bool call(const std::string& service_name, Service& service) {
  return call(service_name, service.request, service.response);
}

/// In milliseconds; negative: for ever.
ROSCPP_DECL bool waitForService(const std::string& service_name, int32_t timeout);
ROSCPP_DECL bool waitForService(const std::string& service_name,
                                ros::Duration timeout = ros::Duration(-1));
ROSCPP_DECL bool exists(const std::string& service_name, bool print_failure_reason);

template <class MReq, class MRes>
ServiceClient createClient(const std::string& service_name, bool persistent = false,
                           const M_string& header_values = M_string()) {
  NodeHandle node;
  return node.template serviceClient<MReq, MRes>(names::resolve(service_name), persistent,
                                                 header_values);
}

template <class Service>
ServiceClient createClient(const std::string& service_name, bool persistent = false,
                           const M_string& header_values = M_string()) {
  NodeHandle node;
  return node.template serviceClient<Service>(names::resolve(service_name), persistent,
                                              header_values);
}

}  // namespace service
}  // namespace ros
