#pragma once

#include <ros/callback_queue_interface.h>
#include <ros/time.h>

#include <memory>

namespace ros {

/// A queue that users call themselves, or spinners for them.
class ROSCPP_DECL CallbackQueue : public CallbackQueueInterface {
 public:
  enum CallOneResult {
    Called,
    TryAgain,
    Disabled,
    Empty,
  };

  CallbackQueue(bool enabled = true);
  virtual ~CallbackQueue();

  virtual void addCallback(const CallbackInterfacePtr& callback, uint64_t removal_id = 0);
  virtual void removeByID(uint64_t removal_id);

  CallOneResult callOne() { return callOne(WallDuration()); }
  /// Calls one; waits this long for it where there is none.
  CallOneResult callOne(WallDuration timeout);
  void callAvailable() { callAvailable(WallDuration()); }
  /// Calls all that are there now; waits this long for the first.
  void callAvailable(WallDuration timeout);

  bool empty() { return isEmpty(); }
  bool isEmpty();
  void clear();
  void enable();
  void disable();
  bool isEnabled();

 private:
  CallbackQueue(const CallbackQueue&);
  CallbackQueue& operator=(const CallbackQueue&);

  struct State;
  std::shared_ptr<State> state_;
};
typedef boost::shared_ptr<CallbackQueue> CallbackQueuePtr;

}  // namespace ros
