#pragma once

#include <ros/common.h>
#include <ros/forwards.h>
#include <ros/message_event.h>
#include <ros/message_traits.h>
#include <ros/parameter_adapter.h>
#include <gazelle/core.hpp>
#include <gazelle/message.hpp>
#include <gazelle/pointers.hpp>

#include <boost/function.hpp>

#include <typeinfo>

namespace ros {

/// Bytes of ROS 1 that become a message.
struct SubscriptionCallbackHelperDeserializeParams {
  uint8_t* buffer;
  uint32_t length;
  boost::shared_ptr<M_string> connection_header;
};

/// A message for a callback.
struct ROSCPP_DECL SubscriptionCallbackHelperCallParams {
  MessageEvent<void const> event;
};

/// A callback whose message type only it knows.
class ROSCPP_DECL SubscriptionCallbackHelper {
 public:
  virtual ~SubscriptionCallbackHelper() {}
  virtual VoidConstPtr deserialize(const SubscriptionCallbackHelperDeserializeParams& params) = 0;
  virtual void call(SubscriptionCallbackHelperCallParams& params) = 0;
  virtual const std::type_info& getTypeInfo() = 0;
  virtual bool isConst() = 0;
  virtual bool hasHeader() = 0;
  /// The class of the messages; null: any type.
  virtual const gazelle::MessageType* messageType() { return 0; }
  /// What came, as the callback's message; `own` is set where nobody else has the object.
  virtual VoidConstPtr receive(const gazelle::Delivered& delivered,
                               const boost::shared_ptr<M_string>& header, bool& own) = 0;
};

namespace detail {

template <class M, class = void>
struct IsDescribed : std::false_type {};
template <class M>
struct IsDescribed<M, decltype(static_cast<void>(sizeof(gazelle::Description<M>)))>
    : std::true_type {};

/// Classes that are no generated messages: those that adapt one by traits and a serializer of
/// their own (ROS 1's bytes), and topic_tools::ShapeShifter, which is any message.
template <class M>
struct ForeignMessage;

template <class M>
const gazelle::MessageType* messageTypeOf() {
  if constexpr (IsDescribed<M>::value) {
    return &gazelle::message_type<M>();
  } else {
    return ForeignMessage<M>::type();
  }
}

/// A copy of a message, for subscriptions in this process.
template <class M>
std::shared_ptr<const void> copyOf(const void* message) {
  return std::make_shared<M>(*static_cast<const M*>(message));
}

ROSCPP_DECL VoidConstPtr objectOf(const gazelle::Delivered& delivered,
                                  const gazelle::MessageType& type, bool wants_own, bool& own);

}  // namespace detail

template <typename P, typename Enabled = void>
class SubscriptionCallbackHelperT : public SubscriptionCallbackHelper {
 public:
  typedef ParameterAdapter<P> Adapter;
  typedef typename Adapter::Message NonConstType;
  typedef typename Adapter::Event Event;
  typedef typename std::add_const<NonConstType>::type ConstType;
  typedef boost::shared_ptr<NonConstType> NonConstTypePtr;
  typedef boost::shared_ptr<ConstType> ConstTypePtr;
  static const bool is_const = Adapter::is_const;
  typedef boost::function<void(typename Adapter::Parameter)> Callback;
  typedef boost::function<NonConstTypePtr()> CreateFunction;

  SubscriptionCallbackHelperT(const Callback& callback,
                              const CreateFunction& create = DefaultMessageCreator<NonConstType>())
      : callback_(callback), create_(create) {}

  void setCreateFunction(const CreateFunction& create) { create_ = create; }
  virtual bool hasHeader() {
    return message_traits::hasHeader<typename ParameterAdapter<P>::Message>();
  }
  virtual VoidConstPtr deserialize(const SubscriptionCallbackHelperDeserializeParams& params);
  virtual void call(SubscriptionCallbackHelperCallParams& params) {
    Event event(params.event, create_);
    callback_(ParameterAdapter<P>::getParameter(event));
  }
  virtual const std::type_info& getTypeInfo() { return typeid(NonConstType); }
  virtual bool isConst() { return ParameterAdapter<P>::is_const; }
  virtual const gazelle::MessageType* messageType() {
    return detail::messageTypeOf<NonConstType>();
  }
  virtual VoidConstPtr receive(const gazelle::Delivered& delivered,
                               const boost::shared_ptr<M_string>& header, bool& own) {
    if constexpr (detail::IsDescribed<NonConstType>::value) {
      static_cast<void>(header);
      return detail::objectOf(delivered, gazelle::message_type<NonConstType>(), !is_const, own);
    } else {
      own = true;
      return detail::ForeignMessage<NonConstType>::receive(delivered, header, create_);
    }
  }

 private:
  Callback callback_;
  CreateFunction create_;
};

}  // namespace ros

#include <ros/foreign_message.h>
