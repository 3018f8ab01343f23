#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/service_callback_helper.h>
#include <ros/service_client_options.h>
#include <ros/service_traits.h>
#include <gazelle/core.hpp>

namespace ros {

/// Asks a service.
class ROSCPP_DECL ServiceClient {
 public:
  ServiceClient() {}

  template <class MReq, class MRes>
  bool call(MReq& request, MRes& response) {
    return ask(&request, &response, *detail::serviceTypeOf<MReq, MRes>());
  }
  template <class MReq, class MRes>
  bool call(const MReq& request, MRes& response) {
    return ask(&request, &response, *detail::serviceTypeOf<MReq, MRes>());
  }
  template <class Service>
  bool call(Service& service) {
    return call(service.request, service.response);
  }
  template <typename MReq, typename MRes>
  bool call(const MReq& request, MRes& response, const std::string& service_md5sum) {
    static_cast<void>(service_md5sum);
    return call(request, response);
  }

  bool isPersistent() const;
  bool isValid() const;
  void shutdown();
  /// Waits until somebody offers it; a negative timeout waits for ever.
  bool waitForExistence(ros::Duration timeout = ros::Duration(-1));
  bool exists();
  std::string getService();

  operator void*() const { return isValid() ? reinterpret_cast<void*>(1) : 0; }
  bool operator<(const ServiceClient& other) const { return impl_ < other.impl_; }
  bool operator==(const ServiceClient& other) const { return impl_ == other.impl_; }
  bool operator!=(const ServiceClient& other) const { return impl_ != other.impl_; }

  class Impl;

 private:
  friend class NodeHandle;
  explicit ServiceClient(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}

  /// Encodes, asks, and puts what comes back into the response.
  bool ask(const void* request, void* response, const gazelle::ServiceType& type) const {
    std::vector<uint8_t> cdr;
    type.request->encode(request, cdr);
    gazelle::Bytes answer;
    return askBytes(std::move(cdr), answer, type) && readResponse(answer, response, type);
  }
  bool askBytes(std::vector<uint8_t> request, gazelle::Bytes& response,
                const gazelle::ServiceType& type) const;
  bool readResponse(const gazelle::Bytes& answer, void* response,
                    const gazelle::ServiceType& type) const;

  boost::shared_ptr<Impl> impl_;
};
typedef boost::shared_ptr<ServiceClient> ServiceClientPtr;

}  // namespace ros
