#pragma once

#include <ros/advertise_options.h>
#include <ros/advertise_service_options.h>
#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/param.h>
#include <ros/publisher.h>
#include <ros/rate.h>
#include <ros/service_client.h>
#include <ros/service_client_options.h>
#include <ros/service_server.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/spinner.h>
#include <ros/steady_timer.h>
#include <ros/subscribe_options.h>
#include <ros/subscriber.h>
#include <ros/timer.h>
#include <ros/wall_timer.h>

#include <boost/bind.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "xmlrpcpp/XmlRpcValue.h"

namespace ros {

class NodeHandleBackingCollection;

/// A namespace to work in. The node is in the graph while there is one.
class ROSCPP_DECL NodeHandle {
 public:
  NodeHandle(const std::string& ns = std::string(), const M_string& remappings = M_string());
  NodeHandle(const NodeHandle& other);
  NodeHandle(const NodeHandle& parent, const std::string& ns);
  NodeHandle(const NodeHandle& parent, const std::string& ns, const M_string& remappings);
  ~NodeHandle();
  NodeHandle& operator=(const NodeHandle& other);

  void setCallbackQueue(CallbackQueueInterface* queue) { callback_queue_ = queue; }
  CallbackQueueInterface* getCallbackQueue() const;
  const std::string& getNamespace() const { return namespace_; }
  const std::string& getUnresolvedNamespace() const { return unresolved_namespace_; }
  std::string resolveName(const std::string& name, bool remap = true) const;
  bool ok() const;
  /// Ends everything that was made by this handle and its copies.
  void shutdown();

  // ---- Publishers
  template <class M>
  Publisher advertise(const std::string& topic, uint32_t queue_size, bool latch = false) {
    AdvertiseOptions options;
    options.template init<M>(topic, queue_size);
    options.latch = latch;
    return advertise(options);
  }
  template <class M>
  Publisher advertise(const std::string& topic, uint32_t queue_size,
                      const SubscriberStatusCallback& connect_cb,
                      const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                      const VoidConstPtr& tracked_object = VoidConstPtr(), bool latch = false) {
    AdvertiseOptions options;
    options.template init<M>(topic, queue_size, connect_cb, disconnect_cb);
    options.tracked_object = tracked_object;
    options.latch = latch;
    return advertise(options);
  }
  Publisher advertise(AdvertiseOptions& options);

  // ---- Subscribers
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*method)(M),
                       T* object, const TransportHints& hints = TransportHints()) {
    return subscribeBy<M>(topic, queue_size, boost::bind(method, object, boost::placeholders::_1),
                          VoidConstPtr(), hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*method)(M) const,
                       T* object, const TransportHints& hints = TransportHints()) {
    return subscribeBy<M>(topic, queue_size, boost::bind(method, object, boost::placeholders::_1),
                          VoidConstPtr(), hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*method)(M),
                       const boost::shared_ptr<T>& object,
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<M>(topic, queue_size,
                          boost::bind(method, object.get(), boost::placeholders::_1), object,
                          hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (T::*method)(M) const,
                       const boost::shared_ptr<T>& object,
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<M>(topic, queue_size,
                          boost::bind(method, object.get(), boost::placeholders::_1), object,
                          hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (T::*method)(const boost::shared_ptr<M const>&), T* object,
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<const boost::shared_ptr<M const>&>(
        topic, queue_size, boost::bind(method, object, boost::placeholders::_1), VoidConstPtr(),
        hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (T::*method)(const boost::shared_ptr<M const>&) const, T* object,
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<const boost::shared_ptr<M const>&>(
        topic, queue_size, boost::bind(method, object, boost::placeholders::_1), VoidConstPtr(),
        hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (T::*method)(const boost::shared_ptr<M const>&),
                       const boost::shared_ptr<T>& object,
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<const boost::shared_ptr<M const>&>(
        topic, queue_size, boost::bind(method, object.get(), boost::placeholders::_1), object,
        hints);
  }
  template <class M, class T>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (T::*method)(const boost::shared_ptr<M const>&) const,
                       const boost::shared_ptr<T>& object,
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<const boost::shared_ptr<M const>&>(
        topic, queue_size, boost::bind(method, object.get(), boost::placeholders::_1), object,
        hints);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size, void (*function)(M),
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<M>(topic, queue_size, function, VoidConstPtr(), hints);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       void (*function)(const boost::shared_ptr<M const>&),
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<const boost::shared_ptr<M const>&>(topic, queue_size, function,
                                                          VoidConstPtr(), hints);
  }
  template <class M>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       const boost::function<void(const boost::shared_ptr<M const>&)>& callback,
                       const VoidConstPtr& tracked_object = VoidConstPtr(),
                       const TransportHints& hints = TransportHints()) {
    SubscribeOptions options;
    options.template init<M>(topic, queue_size, callback);
    options.tracked_object = tracked_object;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class M, class C>
  Subscriber subscribe(const std::string& topic, uint32_t queue_size,
                       const boost::function<void(C)>& callback,
                       const VoidConstPtr& tracked_object = VoidConstPtr(),
                       const TransportHints& hints = TransportHints()) {
    return subscribeBy<C>(topic, queue_size, callback, tracked_object, hints);
  }
  Subscriber subscribe(SubscribeOptions& options);

  // ---- Services
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*method)(MReq&, MRes&),
                                 T* object) {
    return offerBy<ServiceSpec<MReq, MRes>>(
        service, boost::bind(method, object, boost::placeholders::_1, boost::placeholders::_2),
        VoidConstPtr());
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*method)(MReq&, MRes&) const,
                                 T* object) {
    return offerBy<ServiceSpec<MReq, MRes>>(
        service, boost::bind(method, object, boost::placeholders::_1, boost::placeholders::_2),
        VoidConstPtr());
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*method)(MReq&, MRes&),
                                 const boost::shared_ptr<T>& object) {
    return offerBy<ServiceSpec<MReq, MRes>>(
        service,
        boost::bind(method, object.get(), boost::placeholders::_1, boost::placeholders::_2),
        object);
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (T::*method)(MReq&, MRes&) const,
                                 const boost::shared_ptr<T>& object) {
    return offerBy<ServiceSpec<MReq, MRes>>(
        service,
        boost::bind(method, object.get(), boost::placeholders::_1, boost::placeholders::_2),
        object);
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service,
                                 bool (T::*method)(ServiceEvent<MReq, MRes>&), T* object) {
    return offerBy<ServiceEvent<MReq, MRes>>(
        service, boost::bind(method, object, boost::placeholders::_1), VoidConstPtr());
  }
  template <class T, class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service,
                                 bool (T::*method)(ServiceEvent<MReq, MRes>&),
                                 const boost::shared_ptr<T>& object) {
    return offerBy<ServiceEvent<MReq, MRes>>(
        service, boost::bind(method, object.get(), boost::placeholders::_1), object);
  }
  template <class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service, bool (*function)(MReq&, MRes&)) {
    return offerBy<ServiceSpec<MReq, MRes>>(service, function, VoidConstPtr());
  }
  template <class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service,
                                 bool (*function)(ServiceEvent<MReq, MRes>&)) {
    return offerBy<ServiceEvent<MReq, MRes>>(service, function, VoidConstPtr());
  }
  template <class MReq, class MRes>
  ServiceServer advertiseService(const std::string& service,
                                 const boost::function<bool(MReq&, MRes&)>& callback,
                                 const VoidConstPtr& tracked_object = VoidConstPtr()) {
    return offerBy<ServiceSpec<MReq, MRes>>(service, callback, tracked_object);
  }
  template <class S>
  ServiceServer advertiseService(const std::string& service,
                                 const boost::function<bool(S&)>& callback,
                                 const VoidConstPtr& tracked_object = VoidConstPtr()) {
    return offerBy<S>(service, callback, tracked_object);
  }
  ServiceServer advertiseService(AdvertiseServiceOptions& options);

  template <class MReq, class MRes>
  ServiceClient serviceClient(const std::string& service_name, bool persistent = false,
                              const M_string& header_values = M_string()) {
    ServiceClientOptions options;
    options.template init<MReq, MRes>(service_name, persistent, header_values);
    return serviceClient(options);
  }
  template <class Service>
  ServiceClient serviceClient(const std::string& service_name, bool persistent = false,
                              const M_string& header_values = M_string()) {
    ServiceClientOptions options;
    options.template init<Service>(service_name, persistent, header_values);
    return serviceClient(options);
  }
  ServiceClient serviceClient(ServiceClientOptions& options);

  // ---- Timers
  template <class Handler, class Obj>
  Timer createTimer(Rate rate, Handler handler, Obj object, bool oneshot = false,
                    bool autostart = true) const {
    return createTimer(rate.expectedCycleTime(), handler, object, oneshot, autostart);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&), T* object,
                    bool oneshot = false, bool autostart = true) const {
    TimerOptions options(period, boost::bind(callback, object, boost::placeholders::_1), 0, oneshot,
                         autostart);
    options.tracked_object = VoidConstPtr();
    return createTimer(options);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&) const, T* object,
                    bool oneshot = false, bool autostart = true) const {
    TimerOptions options(period, boost::bind(callback, object, boost::placeholders::_1), 0, oneshot,
                         autostart);
    options.tracked_object = VoidConstPtr();
    return createTimer(options);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&),
                    const boost::shared_ptr<T>& object, bool oneshot = false,
                    bool autostart = true) const {
    TimerOptions options(period, boost::bind(callback, object.get(), boost::placeholders::_1), 0,
                         oneshot, autostart);
    options.tracked_object = object;
    return createTimer(options);
  }
  template <class T>
  Timer createTimer(Duration period, void (T::*callback)(const TimerEvent&) const,
                    const boost::shared_ptr<T>& object, bool oneshot = false,
                    bool autostart = true) const {
    TimerOptions options(period, boost::bind(callback, object.get(), boost::placeholders::_1), 0,
                         oneshot, autostart);
    options.tracked_object = object;
    return createTimer(options);
  }
  Timer createTimer(Duration period, const TimerCallback& callback, bool oneshot = false,
                    bool autostart = true) const;
  Timer createTimer(TimerOptions& options) const;
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&),
                            T* object, bool oneshot = false, bool autostart = true) const {
    WallTimerOptions options(period, boost::bind(callback, object, boost::placeholders::_1), 0,
                             oneshot, autostart);
    options.tracked_object = VoidConstPtr();
    return createWallTimer(options);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&) const,
                            T* object, bool oneshot = false, bool autostart = true) const {
    WallTimerOptions options(period, boost::bind(callback, object, boost::placeholders::_1), 0,
                             oneshot, autostart);
    options.tracked_object = VoidConstPtr();
    return createWallTimer(options);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&),
                            const boost::shared_ptr<T>& object, bool oneshot = false,
                            bool autostart = true) const {
    WallTimerOptions options(period, boost::bind(callback, object.get(), boost::placeholders::_1),
                             0, oneshot, autostart);
    options.tracked_object = object;
    return createWallTimer(options);
  }
  template <class T>
  WallTimer createWallTimer(WallDuration period, void (T::*callback)(const WallTimerEvent&) const,
                            const boost::shared_ptr<T>& object, bool oneshot = false,
                            bool autostart = true) const {
    WallTimerOptions options(period, boost::bind(callback, object.get(), boost::placeholders::_1),
                             0, oneshot, autostart);
    options.tracked_object = object;
    return createWallTimer(options);
  }
  WallTimer createWallTimer(WallDuration period, const WallTimerCallback& callback,
                            bool oneshot = false, bool autostart = true) const;
  WallTimer createWallTimer(WallTimerOptions& options) const;
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&),
                                T* object, bool oneshot = false, bool autostart = true) const {
    SteadyTimerOptions options(period, boost::bind(callback, object, boost::placeholders::_1), 0,
                               oneshot, autostart);
    options.tracked_object = VoidConstPtr();
    return createSteadyTimer(options);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period,
                                void (T::*callback)(const SteadyTimerEvent&) const, T* object,
                                bool oneshot = false, bool autostart = true) const {
    SteadyTimerOptions options(period, boost::bind(callback, object, boost::placeholders::_1), 0,
                               oneshot, autostart);
    options.tracked_object = VoidConstPtr();
    return createSteadyTimer(options);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period, void (T::*callback)(const SteadyTimerEvent&),
                                const boost::shared_ptr<T>& object, bool oneshot = false,
                                bool autostart = true) const {
    SteadyTimerOptions options(period, boost::bind(callback, object.get(), boost::placeholders::_1),
                               0, oneshot, autostart);
    options.tracked_object = object;
    return createSteadyTimer(options);
  }
  template <class T>
  SteadyTimer createSteadyTimer(WallDuration period,
                                void (T::*callback)(const SteadyTimerEvent&) const,
                                const boost::shared_ptr<T>& object, bool oneshot = false,
                                bool autostart = true) const {
    SteadyTimerOptions options(period, boost::bind(callback, object.get(), boost::placeholders::_1),
                               0, oneshot, autostart);
    options.tracked_object = object;
    return createSteadyTimer(options);
  }
  SteadyTimer createSteadyTimer(WallDuration period, const SteadyTimerCallback& callback,
                                bool oneshot = false, bool autostart = true) const;
  SteadyTimer createSteadyTimer(SteadyTimerOptions& options) const;

  // ---- Parameters
  void setParam(const std::string& key, const XmlRpc::XmlRpcValue& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::string& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const char* value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, double value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, int value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, bool value) const { param::set(resolveName(key), value); }
  void setParam(const std::string& key, const std::vector<std::string>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, std::string>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::vector<double>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, double>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::vector<float>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, float>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::vector<int>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, int>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::vector<bool>& value) const {
    param::set(resolveName(key), value);
  }
  void setParam(const std::string& key, const std::map<std::string, bool>& value) const {
    param::set(resolveName(key), value);
  }
  bool getParam(const std::string& key, XmlRpc::XmlRpcValue& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::string& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, double& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, float& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, int& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, bool& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<std::string>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, std::string>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<double>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, double>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<float>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, float>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<int>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, int>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::vector<bool>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParam(const std::string& key, std::map<std::string, bool>& value) const {
    return param::get(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, XmlRpc::XmlRpcValue& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::string& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, double& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, float& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, int& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, bool& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<std::string>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, std::string>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<double>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, double>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<float>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, float>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<int>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, int>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::vector<bool>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool getParamCached(const std::string& key, std::map<std::string, bool>& value) const {
    return param::getCached(resolveName(key), value);
  }
  bool hasParam(const std::string& key) const { return param::has(resolveName(key)); }
  bool searchParam(const std::string& key, std::string& result) const;
  bool deleteParam(const std::string& key) const { return param::del(resolveName(key)); }
  bool getParamNames(std::vector<std::string>& keys) const { return param::getParamNames(keys); }

  /// Reads a parameter; false, and the default, where it is not set.
  template <typename T>
  bool param(const std::string& name, T& value, const T& default_value) const {
    if (hasParam(name) && getParam(name, value)) return true;
    value = default_value;
    return false;
  }
  template <typename T>
  T param(const std::string& name, const T& default_value) const {
    T value;
    param(name, value, default_value);
    return value;
  }

 private:
  template <class P, class Callback>
  Subscriber subscribeBy(const std::string& topic, uint32_t queue_size, const Callback& callback,
                         const VoidConstPtr& tracked_object, const TransportHints& hints) {
    SubscribeOptions options;
    options.template initByFullCallbackType<P>(topic, queue_size, callback);
    options.tracked_object = tracked_object;
    options.transport_hints = hints;
    return subscribe(options);
  }
  template <class Spec, class Callback>
  ServiceServer offerBy(const std::string& service, const Callback& callback,
                        const VoidConstPtr& tracked_object) {
    AdvertiseServiceOptions options;
    options.template initBySpecType<Spec>(service, callback);
    options.tracked_object = tracked_object;
    return advertiseService(options);
  }

  void construct(const std::string& ns, bool validate_name);
  void initRemappings(const M_string& remappings);
  std::string remapName(const std::string& name) const;

  std::string namespace_;
  std::string unresolved_namespace_;
  M_string remappings_;
  M_string unresolved_remappings_;
  CallbackQueueInterface* callback_queue_;
  /// What was made here; NodeHandleBackingCollection is private to the runtime.
  std::shared_ptr<NodeHandleBackingCollection> collection_;
};

}  // namespace ros
