#pragma once

#include <ros/common.h>

namespace ros {
namespace network {

ROSCPP_DECL bool splitURI(const std::string& uri, std::string& host, uint32_t& port);
ROSCPP_DECL const std::string& getHost();
ROSCPP_DECL uint16_t getTCPROSPort();

}  // namespace network
}  // namespace ros
