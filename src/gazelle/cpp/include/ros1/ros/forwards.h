#pragma once

#include <ros/datatypes.h>
#include <ros/exceptions.h>
#include <ros/macros.h>
#include <ros/time.h>

#include <boost/enable_shared_from_this.hpp>
#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/weak_ptr.hpp>

#include <cstdlib>
#include <list>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ros {

typedef boost::shared_ptr<void> VoidPtr;
typedef boost::weak_ptr<void> VoidWPtr;
typedef boost::shared_ptr<void const> VoidConstPtr;
typedef boost::weak_ptr<void const> VoidConstWPtr;

class NodeHandle;
typedef boost::shared_ptr<NodeHandle> NodeHandlePtr;
class Publisher;
class Subscriber;
class ServiceServer;
class ServiceClient;
class Timer;
class WallTimer;
class SteadyTimer;
class SingleSubscriberPublisher;
class TransportHints;
class CallbackQueueInterface;
class CallbackQueue;
class CallbackInterface;
typedef boost::shared_ptr<CallbackInterface> CallbackInterfacePtr;
class SubscriptionCallbackHelper;
typedef boost::shared_ptr<SubscriptionCallbackHelper> SubscriptionCallbackHelperPtr;
class ServiceCallbackHelper;
typedef boost::shared_ptr<ServiceCallbackHelper> ServiceCallbackHelperPtr;

typedef boost::function<void(const SingleSubscriberPublisher&)> SubscriberStatusCallback;
typedef std::vector<std::pair<SubscriberStatusCallback, CallbackQueueInterface*> >
    VP_SubscriberStatusCallback;

/// What a timer tells: when it was meant to fire and when it did.
struct TimerEvent {
  Time last_expected;
  Time last_expired;
  Time last_real;
  Time current_expected;
  Time current_expired;
  Time current_real;
  struct {
    WallDuration last_duration;
  } profile;
};
typedef boost::function<void(const TimerEvent&)> TimerCallback;

/// The same of the machine's time.
struct WallTimerEvent {
  WallTime last_expected;
  WallTime last_expired;
  WallTime last_real;
  WallTime current_expected;
  WallTime current_expired;
  WallTime current_real;
  struct {
    WallDuration last_duration;
  } profile;
};
typedef boost::function<void(const WallTimerEvent&)> WallTimerCallback;

/// The same of the steady clock.
struct SteadyTimerEvent {
  SteadyTime last_expected;
  SteadyTime last_expired;
  SteadyTime last_real;
  SteadyTime current_expected;
  SteadyTime current_expired;
  SteadyTime current_real;
  struct {
    WallDuration last_duration;
  } profile;
};
typedef boost::function<void(const SteadyTimerEvent&)> SteadyTimerCallback;

class ServiceManager;
class TopicManager;
class ConnectionManager;
class XMLRPCManager;
class PollManager;

}  // namespace ros
