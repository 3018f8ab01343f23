#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

#include <map>
#include <vector>

#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {
namespace param {

// One declaration a type for set, get and getCached: what the parameter server stores, and lists
// and tables of it.
#define GAZELLE_ROS_PARAMETER(Type, Passed)                   \
  ROSCPP_DECL void set(const std::string& key, Passed value); \
  ROSCPP_DECL bool get(const std::string& key, Type& value);  \
  ROSCPP_DECL bool getCached(const std::string& key, Type& value);
#define GAZELLE_ROS_PARAMETER_LISTS(Type)                                                 \
  ROSCPP_DECL void set(const std::string& key, const std::vector<Type>& value);           \
  ROSCPP_DECL bool get(const std::string& key, std::vector<Type>& value);                 \
  ROSCPP_DECL bool getCached(const std::string& key, std::vector<Type>& value);           \
  ROSCPP_DECL void set(const std::string& key, const std::map<std::string, Type>& value); \
  ROSCPP_DECL bool get(const std::string& key, std::map<std::string, Type>& value);       \
  ROSCPP_DECL bool getCached(const std::string& key, std::map<std::string, Type>& value);

GAZELLE_ROS_PARAMETER(XmlRpc::XmlRpcValue, const XmlRpc::XmlRpcValue&)
GAZELLE_ROS_PARAMETER(std::string, const std::string&)
GAZELLE_ROS_PARAMETER(double, double)
GAZELLE_ROS_PARAMETER(int, int)
GAZELLE_ROS_PARAMETER(bool, bool)
ROSCPP_DECL void set(const std::string& key, const char* value);
ROSCPP_DECL bool get(const std::string& key, float& value);
ROSCPP_DECL bool getCached(const std::string& key, float& value);
GAZELLE_ROS_PARAMETER_LISTS(std::string)
GAZELLE_ROS_PARAMETER_LISTS(double)
GAZELLE_ROS_PARAMETER_LISTS(float)
GAZELLE_ROS_PARAMETER_LISTS(int)
GAZELLE_ROS_PARAMETER_LISTS(bool)

#undef GAZELLE_ROS_PARAMETER
#undef GAZELLE_ROS_PARAMETER_LISTS

ROSCPP_DECL bool has(const std::string& key);
ROSCPP_DECL bool del(const std::string& key);
ROSCPP_DECL bool search(const std::string& ns, const std::string& key, std::string& result);
ROSCPP_DECL bool search(const std::string& key, std::string& result);
ROSCPP_DECL bool getParamNames(std::vector<std::string>& keys);
ROSCPP_DECL void unsubscribeCachedParam(const std::string& key);
ROSCPP_DECL void unsubscribeCachedParam();

/// Reads a parameter; false, and the default, where it is not set.
template <typename T>
bool param(const std::string& name, T& value, const T& default_value) {
  if (has(name) && get(name, value)) return true;
  value = default_value;
  return false;
}

template <typename T>
T param(const std::string& name, const T& default_value) {
  T value;
  param(name, value, default_value);
  return value;
}

}  // namespace param
}  // namespace ros
