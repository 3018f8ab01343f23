#pragma once

#include <ros/common.h>
#include <ros/types.h>

#include <boost/shared_ptr.hpp>

namespace ros {

class NodeHandle;
class CallbackQueue;

/// Calls callbacks until the node ends.
class ROSCPP_DECL Spinner {
 public:
  virtual ~Spinner() {}
  virtual void spin(CallbackQueue* queue = 0) = 0;
};

/// In the thread that called spin().
class ROSCPP_DECL SingleThreadedSpinner : public Spinner {
 public:
  virtual void spin(CallbackQueue* queue = 0);
};

/// In several threads; spin() comes back when the node ends.
class ROSCPP_DECL MultiThreadedSpinner : public Spinner {
 public:
  /// As many threads as the machine has cores where 0 is asked for.
  MultiThreadedSpinner(uint32_t thread_count = 0);
  virtual void spin(CallbackQueue* queue = 0);

 private:
  uint32_t thread_count_;
};

class AsyncSpinnerImpl;
typedef boost::shared_ptr<AsyncSpinnerImpl> AsyncSpinnerImplPtr;

/// In several threads, between start() and stop().
class ROSCPP_DECL AsyncSpinner {
 public:
  AsyncSpinner(uint32_t thread_count);
  AsyncSpinner(uint32_t thread_count, CallbackQueue* queue);
  bool canStart();
  void start();
  void stop();

 private:
  AsyncSpinnerImplPtr impl_;
};

}  // namespace ros
