// What publishers, subscribers, services and clients of roscpp are inside.
#pragma once

#include <ros/advertise_options.h>
#include <ros/callback_queue_interface.h>
#include <ros/foreign_message.h>
#include <ros/publisher.h>
#include <ros/service_client.h>
#include <ros/service_server.h>
#include <ros/subscribe_options.h>
#include <ros/subscriber.h>
#include <gazelle/core.hpp>

#include <atomic>
#include <deque>
#include <mutex>
#include <unordered_map>

#include "node_state.hpp"

namespace ros {

class Publisher::Impl : public detail::End {
 public:
  ~Impl() override;
  void close(bool waiting) override;

  std::string topic, datatype, md5sum, definition;
  bool latch = false;
  uint64_t owner = detail::newOwner();
  CallbackQueueInterface* queue = nullptr;
  std::shared_ptr<gazelle::Publisher> publisher;
  std::atomic<bool> is_closed{false};
  std::atomic<const gazelle::MessageType*> accepted{nullptr};
  std::mutex mutex;
};

// The messages of one subscription that wait; the queue of callbacks holds it once for each.
class SubscriptionQueue : public CallbackInterface,
                          public boost::enable_shared_from_this<SubscriptionQueue> {
 public:
  explicit SubscriptionQueue(const SubscribeOptions& options);
  void push(gazelle::Delivered delivered);
  void close();
  CallResult call() override;
  bool ready() override;

  const uint64_t owner = detail::newOwner();
  CallbackQueueInterface* const queue;

 private:
  struct Waiting {
    gazelle::Delivered delivered;
    Time receipt;
  };
  const boost::shared_ptr<M_string>& headerOf(const gazelle::Delivered& delivered);
  void deliver(const Waiting& waiting);

  const SubscriptionCallbackHelperPtr helper_;
  const std::string topic_;
  const std::size_t size_;
  const bool is_concurrent_;
  const bool is_tracked_;
  const boost::weak_ptr<void const> tracked_;
  std::mutex mutex_;
  std::deque<Waiting> waiting_;
  bool is_closed_ = false;
  bool was_full_ = false;
  std::atomic<int> calling_{0};
  std::mutex headers_mutex_;
  std::unordered_map<std::string, boost::shared_ptr<M_string> > headers_;
};

class Subscriber::Impl : public detail::End {
 public:
  ~Impl() override;
  void close(bool waiting) override;

  std::string topic;
  boost::shared_ptr<SubscriptionQueue> messages;
  std::shared_ptr<gazelle::Subscription> subscription;
  std::atomic<bool> is_closed{false};
};

class ServiceServer::Impl : public detail::End {
 public:
  ~Impl() override;
  void close(bool waiting) override;

  std::string service;
  uint64_t owner = detail::newOwner();
  CallbackQueueInterface* queue = nullptr;
  std::shared_ptr<gazelle::ServiceServer> server;
  std::atomic<bool> is_closed{false};
};

class ServiceClient::Impl : public detail::End {
 public:
  ~Impl() override;
  void close(bool waiting) override;
  // Made when the type is known: by the client's options, or by the first call.
  std::shared_ptr<gazelle::ServiceClient> clientOf(const gazelle::ServiceType& type);

  std::string service, md5sum;
  bool is_persistent = false;
  std::atomic<bool> is_closed{false};
  std::mutex mutex;
  std::shared_ptr<gazelle::ServiceClient> client;
};

}  // namespace ros
