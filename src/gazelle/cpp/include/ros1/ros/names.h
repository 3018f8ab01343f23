#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

namespace ros {
namespace names {

/// Makes one slash of several, and none at the end.
ROSCPP_DECL std::string clean(const std::string& name);
ROSCPP_DECL std::string resolve(const std::string& name, bool remap = true);
ROSCPP_DECL std::string resolve(const std::string& ns, const std::string& name, bool remap = true);
ROSCPP_DECL std::string append(const std::string& left, const std::string& right);
ROSCPP_DECL std::string remap(const std::string& name);
ROSCPP_DECL bool validate(const std::string& name, std::string& error);
ROSCPP_DECL const M_string& getRemappings();
ROSCPP_DECL const M_string& getUnresolvedRemappings();
ROSCPP_DECL std::string parentNamespace(const std::string& name);

}  // namespace names
}  // namespace ros
