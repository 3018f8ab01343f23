#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/service_callback_helper.h>
#include <ros/service_traits.h>

namespace ros {

/// All that a client may be told.
struct ROSCPP_DECL ServiceClientOptions {
  ServiceClientOptions() : persistent(false), type(0) {}
  ServiceClientOptions(const std::string& service_, const std::string& md5sum_, bool persistent_,
                       const M_string& header_)
      : service(service_), md5sum(md5sum_), persistent(persistent_), header(header_), type(0) {}

  template <class MReq, class MRes>
  void init(const std::string& service_, bool persistent_, const M_string& header_) {
    service = service_;
    md5sum = service_traits::md5sum<MReq>();
    persistent = persistent_;
    header = header_;
    type = detail::serviceTypeOf<MReq, MRes>();
  }
  template <class Service>
  void init(const std::string& service_, bool persistent_, const M_string& header_) {
    init<typename Service::Request, typename Service::Response>(service_, persistent_, header_);
  }

  std::string service;
  std::string md5sum;
  bool persistent;
  M_string header;
  const gazelle::ServiceType* type;  ///< Gazelle's: known where init() was given types
};

}  // namespace ros
