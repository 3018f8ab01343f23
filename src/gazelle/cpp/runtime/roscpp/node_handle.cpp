// NodeHandle: a namespace, and the ends that are made in it.

#include <ros/node_handle.h>

#include <ros/console.h>
#include <ros/names.h>
#include <ros/this_node.h>
#include <ros/topic.h>

#include <atomic>
#include <csignal>
#include <mutex>

#include "ends.hpp"

namespace ros {

/// What one handle and its copies have made.
class NodeHandleBackingCollection {
 public:
  void add(const boost::shared_ptr<detail::End>& end) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_.push_back(end);
    detail::keep(end);
  }
  void close() {
    std::vector<boost::weak_ptr<detail::End> > ends;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends.swap(ends_);
    }
    for (const auto& kept : ends)
      if (const boost::shared_ptr<detail::End> end = kept.lock()) end->close(true);
  }

 private:
  std::mutex mutex_;
  std::vector<boost::weak_ptr<detail::End> > ends_;
};

namespace {

// The node is in the graph from the first handle to the last.
std::mutex handles_mutex;
int handles = 0;
bool is_started_by_handle = false;

void addHandle() {
  const std::lock_guard<std::mutex> lock(handles_mutex);
  if (++handles == 1 && !isStarted()) {
    is_started_by_handle = true;
    start();
  }
}

void dropHandle() {
  bool is_last = false;
  {
    const std::lock_guard<std::mutex> lock(handles_mutex);
    is_last = --handles == 0 && is_started_by_handle;
  }
  if (is_last) shutdown();
}

bool reportError(const char* what, const std::string& name, const std::exception& error) {
  ROS_ERROR("%s '%s': %s", what, name.c_str(), error.what());
  return false;
}

std::string resolvedBy(const std::string& name, const M_string& remappings) {
  const M_string::const_iterator found = remappings.find(name);
  return found == remappings.end() ? names::remap(name) : found->second;
}

}  // namespace

NodeHandle::NodeHandle(const std::string& ns, const M_string& remappings) : callback_queue_(0) {
  std::string resolved = ns;
  if (!ns.empty() && ns[0] == '~') resolved = names::resolve(ns);
  construct(resolved, true);
  initRemappings(remappings);
}

NodeHandle::NodeHandle(const NodeHandle& parent, const std::string& ns) : callback_queue_(0) {
  namespace_ = parent.getNamespace();
  callback_queue_ = parent.callback_queue_;
  remappings_ = parent.remappings_;
  unresolved_remappings_ = parent.unresolved_remappings_;
  construct(ns, false);
}

NodeHandle::NodeHandle(const NodeHandle& parent, const std::string& ns, const M_string& remappings)
    : callback_queue_(0) {
  namespace_ = parent.getNamespace();
  callback_queue_ = parent.callback_queue_;
  remappings_ = parent.remappings_;
  unresolved_remappings_ = parent.unresolved_remappings_;
  construct(ns, false);
  initRemappings(remappings);
}

NodeHandle::NodeHandle(const NodeHandle& other)
    : namespace_(other.namespace_),
      unresolved_namespace_(other.unresolved_namespace_),
      remappings_(other.remappings_),
      unresolved_remappings_(other.unresolved_remappings_),
      callback_queue_(other.callback_queue_),
      collection_(other.collection_) {
  addHandle();
}

NodeHandle::~NodeHandle() { dropHandle(); }

NodeHandle& NodeHandle::operator=(const NodeHandle& other) {
  namespace_ = other.namespace_;
  unresolved_namespace_ = other.unresolved_namespace_;
  remappings_ = other.remappings_;
  unresolved_remappings_ = other.unresolved_remappings_;
  callback_queue_ = other.callback_queue_;
  collection_ = other.collection_;
  return *this;
}

void NodeHandle::construct(const std::string& ns, bool validate_name) {
  if (!isInitialized()) {
    gazelle::log(gazelle::Level::kFatal,
                 "You must call ros::init() before creating the first NodeHandle",
                 ROSCONSOLE_DEFAULT_NAME);
    std::abort();
  }
  collection_ = std::make_shared<NodeHandleBackingCollection>();
  unresolved_namespace_ = ns;
  // A handle below another has its own remappings for the namespace as well.
  if (validate_name)
    namespace_ = names::resolve(ns, true);
  else
    namespace_ = resolveName(ns, true);
  addHandle();
}

void NodeHandle::initRemappings(const M_string& remappings) {
  for (const auto& pair : remappings) {
    if (pair.first.empty() || pair.first[0] == '_') continue;
    remappings_[resolveName(pair.first, false)] = resolveName(pair.second, false);
    unresolved_remappings_[pair.first] = pair.second;
  }
}

CallbackQueueInterface* NodeHandle::getCallbackQueue() const {
  return callback_queue_ ? callback_queue_ : getGlobalCallbackQueue();
}

std::string NodeHandle::remapName(const std::string& name) const {
  return resolvedBy(resolveName(name, false), remappings_);
}

std::string NodeHandle::resolveName(const std::string& name, bool remap) const {
  std::string error;
  if (!names::validate(name, error)) throw InvalidNameException(error);
  if (!name.empty() && name[0] == '~')
    throw InvalidNameException(
        "Using ~ names with NodeHandle methods is not allowed. Make a private NodeHandle, "
        "ros::NodeHandle(\"~\"), for '" +
        name + "'");
  std::string global = name;
  if (name.empty())
    global = namespace_;
  else if (name[0] != '/')
    global = names::append(namespace_, name);
  global = names::clean(global);
  if (!global.empty() && global[0] != '/') global = "/" + global;
  if (global.empty()) global = "/";
  return remap ? resolvedBy(global, remappings_) : names::resolve(global, false);
}

bool NodeHandle::ok() const { return ros::ok(); }
void NodeHandle::shutdown() { collection_->close(); }

bool NodeHandle::searchParam(const std::string& key, std::string& result) const {
  // The name that was found, put back under a remapping of the handle's own.
  const M_string::const_iterator found = unresolved_remappings_.find(key);
  const std::string wanted = found == unresolved_remappings_.end() ? key : found->second;
  return param::search(namespace_, wanted, result);
}

// ---- Ends

Publisher NodeHandle::advertise(AdvertiseOptions& options) {
  options.topic = resolveName(options.topic);
  if (options.callback_queue == 0) options.callback_queue = getCallbackQueue();
  const std::shared_ptr<gazelle::GraphNode> node = detail::graphNode();
  if (!node) return Publisher();
  if (options.md5sum == "*" || options.datatype == "*") {
    ROS_ERROR("Topic %s cannot be advertised with type *", options.topic.c_str());
    return Publisher();
  }

  const boost::shared_ptr<Publisher::Impl> impl = boost::make_shared<Publisher::Impl>();
  impl->topic = options.topic;
  impl->datatype = options.datatype;
  impl->md5sum = options.md5sum;
  impl->definition = options.message_definition;
  impl->latch = options.latch;
  impl->queue = options.callback_queue;

  gazelle::Qos qos;
  qos.depth = options.queue_size;
  qos.keep_all = options.queue_size == 0;
  gazelle::PublisherOptions more;
  more.latch = options.latch;
  if (options.connect_cb || options.disconnect_cb) {
    const boost::weak_ptr<Publisher::Impl> weak = impl;
    const bool is_tracked = static_cast<bool>(options.tracked_object);
    const VoidConstWPtr tracked = options.tracked_object;
    more.subscriber_changed = [weak, is_tracked, tracked, connect = options.connect_cb,
                               disconnect = options.disconnect_cb](const std::string& subscriber,
                                                                   bool is_there) {
      const boost::shared_ptr<Publisher::Impl> self = weak.lock();
      const SubscriberStatusCallback& callback = is_there ? connect : disconnect;
      if (!self || self->is_closed || !callback) return;
      const boost::function<void()> call = [weak, callback, subscriber] {
        const boost::shared_ptr<Publisher::Impl> self = weak.lock();
        if (!self) return;
        {
          // The callback may come before advertise() has the publisher.
          const std::lock_guard<std::mutex> lock(self->mutex);
          if (self->is_closed) return;
        }
        callback(SingleSubscriberPublisher(Publisher(self), self->topic, subscriber));
      };
      self->queue->addCallback(
          detail::later(call,
                        is_tracked ? tracked : VoidConstWPtr(boost::weak_ptr<void const>(self))),
          self->owner);
    };
  }
  try {
    const std::lock_guard<std::mutex> lock(impl->mutex);
    impl->publisher = options.type
                          ? node->advertise(impl->topic, *options.type, qos, more)
                          : node->advertise(impl->topic, detail::ros2TypeName(impl->datatype),
                                            impl->definition, qos, more);
  } catch (const gazelle::Error& error) {
    reportError("Cannot advertise", impl->topic, error);
    return Publisher();
  }
  collection_->add(impl);
  return Publisher(impl);
}

Subscriber NodeHandle::subscribe(SubscribeOptions& options) {
  options.topic = resolveName(options.topic);
  if (options.callback_queue == 0) options.callback_queue = getCallbackQueue();
  const std::shared_ptr<gazelle::GraphNode> node = detail::graphNode();
  if (!node || !options.helper) return Subscriber();

  const boost::shared_ptr<Subscriber::Impl> impl = boost::make_shared<Subscriber::Impl>();
  impl->topic = options.topic;
  impl->messages = boost::make_shared<SubscriptionQueue>(options);
  gazelle::Qos qos;
  qos.depth = options.queue_size;
  qos.keep_all = options.queue_size == 0;
  const V_string& transports = options.transport_hints.getTransports();
  qos.reliable = transports.empty() || transports.front() != "UDP";
  const boost::weak_ptr<SubscriptionQueue> weak = impl->messages;
  try {
    impl->subscription = node->subscribe(
        impl->topic, options.helper->messageType(), qos, [weak](gazelle::Delivered delivered) {
          if (const boost::shared_ptr<SubscriptionQueue> queue = weak.lock())
            queue->push(std::move(delivered));
        });
  } catch (const gazelle::Error& error) {
    reportError("Cannot subscribe to", impl->topic, error);
    return Subscriber();
  }
  collection_->add(impl);
  return Subscriber(impl);
}

namespace {

// A request that waits in a queue.
class Asked : public CallbackInterface {
 public:
  Asked(const std::shared_ptr<gazelle::ServiceServer>& server, gazelle::RequestId id,
        gazelle::Bytes request, const ServiceCallbackHelperPtr& helper, bool is_tracked,
        const VoidConstWPtr& tracked)
      : server_(server),
        id_(std::move(id)),
        helper_(helper),
        is_tracked_(is_tracked),
        tracked_(tracked) {
    params_.request = std::move(request);
  }
  ~Asked() override {
    // Whoever asks does not wait for a request that a queue dropped.
    if (!is_answered_) server_->fail(id_, "the service ended before it answered");
  }

  virtual CallResult call() {
    VoidConstPtr tracked;
    if (is_tracked_) {
      tracked = tracked_.lock();
      if (!tracked) return Invalid;
    }
    is_answered_ = true;
    params_.connection_header = boost::make_shared<M_string>();
    (*params_.connection_header)["callerid"] = id_.caller;
    (*params_.connection_header)["service"] = server_->name();
    std::string trouble;
    try {
      if (helper_->call(params_)) {
        server_->respond(id_, std::move(params_.response));
        return Success;
      }
    } catch (const std::exception& error) {
      trouble = error.what();
      ROS_ERROR("Exception thrown while processing service call: %s", trouble.c_str());
    }
    server_->fail(id_, trouble);
    return Success;
  }

 private:
  const std::shared_ptr<gazelle::ServiceServer> server_;
  const gazelle::RequestId id_;
  const ServiceCallbackHelperPtr helper_;
  const bool is_tracked_;
  const VoidConstWPtr tracked_;
  ServiceCallbackHelperCallParams params_;
  bool is_answered_ = false;
};

// The server, once it is made: a request may come before advertiseService() is back.
struct Offered {
  std::mutex mutex;
  std::weak_ptr<gazelle::ServiceServer> server;
};

}  // namespace

ServiceServer NodeHandle::advertiseService(AdvertiseServiceOptions& options) {
  options.service = resolveName(options.service);
  if (options.callback_queue == 0) options.callback_queue = getCallbackQueue();
  const std::shared_ptr<gazelle::GraphNode> node = detail::graphNode();
  if (!node || !options.helper || !options.type) return ServiceServer();

  const boost::shared_ptr<ServiceServer::Impl> impl = boost::make_shared<ServiceServer::Impl>();
  impl->service = options.service;
  impl->queue = options.callback_queue;
  const auto offered = std::make_shared<Offered>();
  const bool is_tracked = static_cast<bool>(options.tracked_object);
  const VoidConstWPtr tracked = options.tracked_object;
  const boost::weak_ptr<ServiceServer::Impl> weak = impl;
  try {
    const std::lock_guard<std::mutex> lock(offered->mutex);
    impl->server =
        node->offer(impl->service, *options.type,
                    [weak, offered, is_tracked, tracked, helper = options.helper](
                        gazelle::RequestId id, gazelle::Bytes request) {
                      std::shared_ptr<gazelle::ServiceServer> server;
                      {
                        const std::lock_guard<std::mutex> lock(offered->mutex);
                        server = offered->server.lock();
                      }
                      if (!server) return;
                      const boost::shared_ptr<ServiceServer::Impl> self = weak.lock();
                      if (!self || self->is_closed) {
                        server->fail(id, "the service is gone");
                        return;
                      }
                      self->queue->addCallback(
                          boost::make_shared<Asked>(server, std::move(id), std::move(request),
                                                    helper, is_tracked, tracked),
                          self->owner);
                    });
    offered->server = impl->server;
  } catch (const gazelle::Error& error) {
    reportError("Cannot advertise service", impl->service, error);
    return ServiceServer();
  }
  collection_->add(impl);
  return ServiceServer(impl);
}

ServiceClient NodeHandle::serviceClient(ServiceClientOptions& options) {
  options.service = resolveName(options.service);
  const boost::shared_ptr<ServiceClient::Impl> impl = boost::make_shared<ServiceClient::Impl>();
  impl->service = options.service;
  impl->md5sum = options.md5sum;
  impl->is_persistent = options.persistent;
  collection_->add(impl);
  return ServiceClient(impl);
}

namespace topic {

void waitForMessageImpl(SubscribeOptions& options, const boost::function<bool(void)>& ready,
                        NodeHandle& node, Duration timeout) {
  CallbackQueue queue;
  options.callback_queue = &queue;
  const Subscriber subscriber = node.subscribe(options);
  const Time end = Time::now() + timeout;
  while (!ready() && node.ok()) {
    queue.callAvailable(WallDuration(0.1));
    if (!timeout.isZero() && Time::now() >= end) return;
  }
}

}  // namespace topic

}  // namespace ros
