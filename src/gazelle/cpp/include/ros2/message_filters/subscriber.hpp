// A subscription as a filter.
#pragma once

#include <message_filters/connection.hpp>
#include <message_filters/simple_filter.hpp>
#include <rclcpp/rclcpp.hpp>

#include <memory>
#include <string>

namespace message_filters {

// What can be subscribed and unsubscribed, whatever its type.
template <class NodeType = rclcpp::Node>
class SubscriberBase {
 public:
  using NodePtr = std::shared_ptr<NodeType>;
  virtual ~SubscriberBase() = default;
  virtual void subscribe(NodePtr node, const std::string& topic,
                         const rmw_qos_profile_t qos = rmw_qos_profile_default) = 0;
  virtual void subscribe(NodeType* node, const std::string& topic,
                         const rmw_qos_profile_t qos = rmw_qos_profile_default) = 0;
  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;
};

template <class M, class NodeType = rclcpp::Node>
class Subscriber : public SubscriberBase<NodeType>, public SimpleFilter<M> {
 public:
  using NodePtr = std::shared_ptr<NodeType>;
  using MConstPtr = std::shared_ptr<M const>;
  using EventType = MessageEvent<M const>;
  using Options = rclcpp::SubscriptionOptions;

  Subscriber() = default;
  Subscriber(NodePtr node, const std::string& topic,
             const rmw_qos_profile_t qos = rmw_qos_profile_default) {
    subscribe(node.get(), topic, qos);
    kept_ = node;
  }
  Subscriber(NodeType* node, const std::string& topic,
             const rmw_qos_profile_t qos = rmw_qos_profile_default) {
    subscribe(node, topic, qos);
  }
  Subscriber(NodePtr node, const std::string& topic, const rmw_qos_profile_t qos, Options options) {
    subscribe(node.get(), topic, qos, options);
    kept_ = node;
  }
  Subscriber(NodeType* node, const std::string& topic, const rmw_qos_profile_t qos,
             Options options) {
    subscribe(node, topic, qos, options);
  }
  Subscriber(NodePtr node, const std::string& topic, const rclcpp::QoS& qos,
             Options options = Options()) {
    subscribe(node.get(), topic, qos, options);
    kept_ = node;
  }
  Subscriber(NodeType* node, const std::string& topic, const rclcpp::QoS& qos,
             Options options = Options()) {
    subscribe(node, topic, qos, options);
  }
  ~Subscriber() override { unsubscribe(); }

  void subscribe(NodePtr node, const std::string& topic,
                 const rmw_qos_profile_t qos = rmw_qos_profile_default) override {
    subscribe(node.get(), topic, qos, Options());
    kept_ = node;
  }
  void subscribe(NodeType* node, const std::string& topic,
                 const rmw_qos_profile_t qos = rmw_qos_profile_default) override {
    subscribe(node, topic, qos, Options());
  }
  void subscribe(NodePtr node, const std::string& topic, const rmw_qos_profile_t qos,
                 Options options) {
    subscribe(node.get(), topic, qos, options);
    kept_ = node;
  }
  void subscribe(NodeType* node, const std::string& topic, const rmw_qos_profile_t qos,
                 Options options) {
    subscribe(node, topic, rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(qos), qos), options);
  }
  void subscribe(NodePtr node, const std::string& topic, const rclcpp::QoS& qos,
                 Options options = Options()) {
    subscribe(node.get(), topic, qos, options);
    kept_ = node;
  }
  void subscribe(NodeType* node, const std::string& topic, const rclcpp::QoS& qos,
                 Options options = Options()) {
    unsubscribe();
    if (topic.empty()) return;
    node_ = node;
    topic_ = topic;
    qos_ = qos;
    options_ = options;
    subscription_ = node->template create_subscription<M>(
        topic, qos,
        [this](const std::shared_ptr<const M> message) { this->signalMessage(EventType(message)); },
        options);
  }
  void subscribe() override {
    if (!topic_.empty()) subscribe(node_, std::string(topic_), rclcpp::QoS(qos_), options_);
  }
  void unsubscribe() override { subscription_.reset(); }

  std::string getTopic() const { return topic_; }
  const typename rclcpp::Subscription<M>::SharedPtr getSubscriber() const { return subscription_; }

  // At the front of a chain it takes nothing.
  template <typename F>
  void connectInput(F&) {}
  void add(const EventType&) {}

 private:
  NodePtr kept_;
  NodeType* node_ = nullptr;
  std::string topic_;
  rclcpp::QoS qos_{10};
  Options options_;
  typename rclcpp::Subscription<M>::SharedPtr subscription_;
};

}  // namespace message_filters
