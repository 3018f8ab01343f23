#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/service_callback_helper.h>
#include <ros/service_traits.h>

namespace ros {

/// All that a service may be told.
struct ROSCPP_DECL AdvertiseServiceOptions {
  AdvertiseServiceOptions() : callback_queue(0), type(0) {}

  template <class MReq, class MRes>
  void init(const std::string& service_, const boost::function<bool(MReq&, MRes&)>& callback) {
    initBySpecType<ServiceSpec<MReq, MRes> >(service_, callback);
  }

  template <class Service>
  void init(const std::string& service_,
            const boost::function<bool(typename Service::Request&, typename Service::Response&)>&
                callback) {
    initBySpecType<ServiceSpec<typename Service::Request, typename Service::Response> >(service_,
                                                                                        callback);
  }

  template <class Spec>
  void initBySpecType(const std::string& service_, const typename Spec::CallbackType& callback) {
    typedef typename Spec::RequestType Request;
    typedef typename Spec::ResponseType Response;
    service = service_;
    md5sum = service_traits::md5sum<Request>();
    datatype = service_traits::datatype<Request>();
    req_datatype = message_traits::datatype<Request>();
    res_datatype = message_traits::datatype<Response>();
    helper = boost::make_shared<ServiceCallbackHelperT<Spec> >(callback);
    type = detail::serviceTypeOf<Request, Response>();
  }

  template <class Service>
  static AdvertiseServiceOptions create(
      const std::string& service,
      const boost::function<bool(typename Service::Request&, typename Service::Response&)>&
          callback,
      const VoidConstPtr& tracked_object, CallbackQueueInterface* queue) {
    AdvertiseServiceOptions options;
    options.init<typename Service::Request, typename Service::Response>(service, callback);
    options.tracked_object = tracked_object;
    options.callback_queue = queue;
    return options;
  }

  std::string service;
  std::string md5sum;
  std::string datatype;
  std::string req_datatype;
  std::string res_datatype;
  ServiceCallbackHelperPtr helper;
  CallbackQueueInterface* callback_queue;
  VoidConstPtr tracked_object;
  const gazelle::ServiceType* type;  ///< Gazelle's: what the graph is told
};

}  // namespace ros
