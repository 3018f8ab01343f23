// Topics' ends in this process.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <shared_mutex>
#include <string>
#include <vector>

#include "gazelle/core.hpp"

namespace gazelle {

class PublisherEnd;
class SubscriptionEnd;

using SubscriptionEnds = std::vector<std::shared_ptr<SubscriptionEnd>>;

// One topic's ends in this process; the list of subscriptions is replaced, never changed.
struct LocalTopic {
  std::mutex mutex;  // held while the ends change and while latched messages are handed over
  std::shared_ptr<const SubscriptionEnds> subscriptions = std::make_shared<SubscriptionEnds>();
  std::vector<PublisherEnd*> publishers;

  std::shared_ptr<const SubscriptionEnds> listeners() const {
    return std::atomic_load_explicit(&subscriptions, std::memory_order_acquire);
  }
};

std::shared_ptr<LocalTopic> local_topic(const std::string& name);

class PublisherEnd final : public Publisher, public std::enable_shared_from_this<PublisherEnd> {
 public:
  PublisherEnd(std::uint64_t node, std::string node_name, const Qos& qos,
               const PublisherOptions& options, const MessageType* type);
  ~PublisherEnd() override { close(); }

  // Declare it; `request` goes to the verb topic/advertise.
  void open(Json request);

  void publish(std::shared_ptr<const void> message, const MessageType& type) override;
  void publish_copy(const void* message, const MessageType& type,
                    std::shared_ptr<const void> (*copy)(const void*)) override;
  void publish_cdr(Bytes cdr) override;
  std::size_t subscription_count() const override;
  std::size_t local_subscription_count() const override;
  bool wanted() const override;
  const std::string& topic() const override { return topic_; }
  const std::string& type_name() const override { return type_name_; }
  const std::array<std::uint8_t, 16>& gid() const override { return gid_; }
  const Qos& qos() const override { return qos_; }
  void close() override;
  bool closed() const override { return closed_.load(std::memory_order_acquire); }

  void on_matched(std::size_t count, bool is_wanted_elsewhere);
  void on_subscriber(const std::string& node, bool is_there);
  // Give the last latched message to a new subscription; hold the topic's mutex.
  void hand_latched(SubscriptionEnd& subscription) const;

 private:
  MessageInfo next_info();
  void hand(const Delivered& message, const SubscriptionEnds& subscriptions) const;
  void send(const Delivered& message);
  void send(const void* message, const MessageType& type, const MessageInfo& info);
  void send_bytes(const std::uint8_t* data, std::size_t size, const MessageInfo& info);
  void deliver(const Delivered& message);

  const std::uint64_t node_;
  const std::string node_name_;
  const Qos qos_;
  const PublisherOptions options_;
  const MessageType* type_;
  const bool latched_;
  std::string topic_;
  std::string type_name_;
  std::array<std::uint8_t, 16> gid_{};
  std::shared_ptr<LocalTopic> local_;
  std::uint64_t number_ = 0;  // in the registry
  std::uint64_t handle_ = 0;  // the host's
  std::atomic<std::uint64_t> sequence_{0};
  std::atomic<std::size_t> count_{0};
  std::atomic<bool> is_wanted_elsewhere_{true};
  std::atomic<bool> closed_{true};
  std::recursive_mutex latching_;
  std::optional<Delivered> last_;
};

class SubscriptionEnd final : public Subscription,
                              public std::enable_shared_from_this<SubscriptionEnd> {
 public:
  SubscriptionEnd(std::uint64_t node, std::string node_name, const MessageType* type,
                  const Qos& qos, std::function<void(Delivered)> function,
                  const SubscriptionOptions& options);
  ~SubscriptionEnd() override { close(); }

  void open(Json request);

  std::size_t publisher_count() const override { return count_.load(); }
  const std::string& topic() const override { return topic_; }
  const std::string& type_name() const override { return type_name_; }
  const Qos& qos() const override { return qos_; }
  void close() override;

  // Whether it takes messages of a type and of a node of this process; says it once where the
  // type is another one.
  bool takes(const std::string& type_name, const std::string& node_name);
  void take(Delivered message);
  void on_matched(std::size_t count);
  std::uint64_t node() const { return node_; }

 private:
  const std::uint64_t node_;
  const std::string node_name_;
  const MessageType* type_;
  const Qos qos_;
  std::function<void(Delivered)> function_;
  const SubscriptionOptions options_;
  std::string topic_;
  std::string type_name_;
  std::shared_ptr<LocalTopic> local_;
  std::uint64_t number_ = 0;
  std::uint64_t handle_ = 0;
  std::atomic<std::size_t> count_{0};
  std::atomic<bool> closed_{true};
  std::shared_mutex running_;  // shared while the function runs
  std::mutex refused_mutex_;
  std::set<std::string> refused_;
};

}  // namespace gazelle
