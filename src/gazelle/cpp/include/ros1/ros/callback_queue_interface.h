#pragma once

#include <ros/common.h>
#include <ros/types.h>

#include <boost/shared_ptr.hpp>

#include <cstdint>

namespace ros {

/// Something that waits in a queue to be called.
class ROSCPP_DECL CallbackInterface {
 public:
  enum CallResult {
    Success,   ///< called
    TryAgain,  ///< busy: call it later
    Invalid,   ///< no longer there
  };

  virtual ~CallbackInterface() {}
  virtual CallResult call() = 0;
  virtual bool ready() { return true; }
};

/// Where subscriptions, timers and services put what is to be called.
class ROSCPP_DECL CallbackQueueInterface {
 public:
  virtual ~CallbackQueueInterface() {}
  virtual void addCallback(const CallbackInterfacePtr& callback, uint64_t owner_id = 0) = 0;
  /// Takes out all of an owner's, and waits for the one that is being called.
  virtual void removeByID(uint64_t owner_id) = 0;
};

}  // namespace ros
