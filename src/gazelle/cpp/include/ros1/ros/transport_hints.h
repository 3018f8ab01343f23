#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

#include <cstdlib>

namespace ros {

/// What a subscriber would like of the way messages take. The graph has one way; the hints are
/// kept for whoever asks, and a subscriber that is content with unreliable gets best effort.
class ROSCPP_DECL TransportHints {
 public:
  TransportHints& reliable() { return add("TCP"); }
  TransportHints& tcp() { return add("TCP"); }
  TransportHints& unreliable() { return add("UDP"); }
  TransportHints& udp() { return add("UDP"); }
  TransportHints& tcpNoDelay(bool nodelay = true) {
    options_["tcp_nodelay"] = nodelay ? "true" : "false";
    return *this;
  }
  TransportHints& maxDatagramSize(int size) {
    options_["max_datagram_size"] = std::to_string(size);
    return *this;
  }
  bool getTCPNoDelay() {
    const M_string::const_iterator found = options_.find("tcp_nodelay");
    return found != options_.end() && found->second == "true";
  }
  int getMaxDatagramSize() {
    const M_string::const_iterator found = options_.find("max_datagram_size");
    return found == options_.end() ? 0 : std::atoi(found->second.c_str());
  }
  const V_string& getTransports() { return transports_; }
  const M_string& getOptions() { return options_; }

 private:
  TransportHints& add(const char* transport) {
    transports_.push_back(transport);
    return *this;
  }

  V_string transports_;
  M_string options_;
};

}  // namespace ros
