#pragma once

#include <ros/common.h>
#include <ros/forwards.h>

namespace ros {

/// All that such a timer may be told.
struct ROSCPP_DECL WallTimerOptions {
  WallTimerOptions() : period(0.1), callback_queue(0), oneshot(false), autostart(true) {}
  WallTimerOptions(WallDuration period_, const WallTimerCallback& callback_,
                   CallbackQueueInterface* queue, bool oneshot_ = false, bool autostart_ = true)
      : period(period_),
        callback(callback_),
        callback_queue(queue),
        oneshot(oneshot_),
        autostart(autostart_) {}

  WallDuration period;
  WallTimerCallback callback;
  CallbackQueueInterface* callback_queue;
  VoidConstPtr tracked_object;
  bool oneshot;
  bool autostart;
};

}  // namespace ros
