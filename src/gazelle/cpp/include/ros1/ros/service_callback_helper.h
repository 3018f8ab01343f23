#pragma once

#include <ros/common.h>
#include <ros/foreign_message.h>
#include <ros/forwards.h>
#include <ros/message_traits.h>
#include <ros/service_traits.h>
#include <gazelle/core.hpp>
#include <gazelle/message.hpp>

#include <boost/function.hpp>

#include <string>
#include <vector>

namespace ros {

/// A request as the service got it.
struct ROSCPP_DECL ServiceCallbackHelperCallParams {
  gazelle::Bytes request;         // CDR
  std::vector<uint8_t> response;  // CDR
  boost::shared_ptr<M_string> connection_header;
};

template <typename M>
inline boost::shared_ptr<M> defaultServiceCreateFunction() {
  return boost::make_shared<M>();
}

template <typename MReq, typename MRes>
struct ServiceSpecCallParams {
  boost::shared_ptr<MReq> request;
  boost::shared_ptr<MRes> response;
  boost::shared_ptr<M_string> connection_header;
};

/// A request with who asked.
template <typename MReq, typename MRes>
class ServiceEvent {
 public:
  typedef MReq RequestType;
  typedef MRes ResponseType;
  typedef boost::shared_ptr<RequestType> RequestPtr;
  typedef boost::shared_ptr<ResponseType> ResponsePtr;
  typedef boost::function<bool(ServiceEvent<RequestType, ResponseType>&)> CallbackType;

  ServiceEvent(const boost::shared_ptr<MReq const>& request,
               const boost::shared_ptr<MRes>& response, const boost::shared_ptr<M_string>& header)
      : request_(request), response_(response), connection_header_(header) {}

  static bool call(const CallbackType& callback,
                   ServiceSpecCallParams<RequestType, ResponseType>& params) {
    ServiceEvent<RequestType, ResponseType> event(params.request, params.response,
                                                  params.connection_header);
    return callback(event);
  }
  const RequestType& getRequest() const { return *request_; }
  ResponseType& getResponse() const { return *response_; }
  M_string& getConnectionHeader() const { return *connection_header_; }
  const std::string& getCallerName() const { return (*connection_header_)["callerid"]; }

 private:
  boost::shared_ptr<RequestType const> request_;
  ResponsePtr response_;
  boost::shared_ptr<M_string> connection_header_;
};

template <typename MReq, typename MRes>
struct ServiceSpec {
  typedef MReq RequestType;
  typedef MRes ResponseType;
  typedef boost::shared_ptr<RequestType> RequestPtr;
  typedef boost::shared_ptr<ResponseType> ResponsePtr;
  typedef boost::function<bool(RequestType&, ResponseType&)> CallbackType;

  static bool call(const CallbackType& callback,
                   ServiceSpecCallParams<RequestType, ResponseType>& params) {
    return callback(*params.request, *params.response);
  }
};

/// A service's callback whose types only it knows.
class ROSCPP_DECL ServiceCallbackHelper {
 public:
  virtual ~ServiceCallbackHelper() {}
  virtual bool call(ServiceCallbackHelperCallParams& params) = 0;
};

namespace detail {

/// The type of a service by its request and response, one object each.
template <class MReq, class MRes>
const gazelle::ServiceType* serviceTypeOf() {
  static const std::string name = ros2TypeName(service_traits::datatype<MReq>(), "srv");
  static const gazelle::ServiceType type{name.c_str(),
                                         service_traits::datatype<MReq>(),
                                         service_traits::md5sum<MReq>(),
                                         "",
                                         messageTypeOf<MReq>(),
                                         messageTypeOf<MRes>()};
  return &type;
}

}  // namespace detail

template <typename Spec>
class ServiceCallbackHelperT : public ServiceCallbackHelper {
 public:
  typedef typename Spec::RequestType RequestType;
  typedef typename Spec::ResponseType ResponseType;
  typedef typename Spec::RequestPtr RequestPtr;
  typedef typename Spec::ResponsePtr ResponsePtr;
  typedef typename Spec::CallbackType Callback;
  typedef boost::function<RequestPtr()> ReqCreateFunction;
  typedef boost::function<ResponsePtr()> ResCreateFunction;

  ServiceCallbackHelperT(const Callback& callback, const ReqCreateFunction& = ReqCreateFunction(),
                         const ResCreateFunction& = ResCreateFunction())
      : callback_(callback) {}

  virtual bool call(ServiceCallbackHelperCallParams& params) {
    ServiceSpecCallParams<RequestType, ResponseType> call_params;
    const gazelle::MessageType& request = *detail::messageTypeOf<RequestType>();
    call_params.request = gazelle::to_boost(std::static_pointer_cast<RequestType>(
        request.decode(params.request.data(), params.request.size())));
    call_params.response = boost::make_shared<ResponseType>();
    call_params.connection_header = params.connection_header;
    const bool is_done = Spec::call(callback_, call_params);
    detail::messageTypeOf<ResponseType>()->encode(call_params.response.get(), params.response);
    return is_done;
  }

 private:
  Callback callback_;
};

}  // namespace ros
