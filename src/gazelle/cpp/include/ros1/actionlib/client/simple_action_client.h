#pragma once

#include <actionlib/client/action_client.h>
#include <actionlib/client/simple_client_goal_state.h>
#include <actionlib/client/simple_goal_state.h>
#include <actionlib/client/terminal_state.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>

#ifndef ACTIONLIB_SIMPLE_ACTION_CLIENT_DEPRECATED
#define ACTIONLIB_SIMPLE_ACTION_CLIENT_DEPRECATED
#endif

namespace actionlib {

/// Sends one goal at a time.
template <class ActionSpec>
class SimpleActionClient {
 private:
  ACTION_DEFINITION(ActionSpec)
  typedef ClientGoalHandle<ActionSpec> GoalHandleT;
  typedef SimpleActionClient<ActionSpec> SimpleActionClientT;

 public:
  typedef boost::function<void(const SimpleClientGoalState& state, const ResultConstPtr& result)>
      SimpleDoneCallback;
  typedef boost::function<void()> SimpleActiveCallback;
  typedef boost::function<void(const FeedbackConstPtr& feedback)> SimpleFeedbackCallback;

  /// `spin_thread`: callbacks come in a thread of the client's own, so that the program may wait.
  SimpleActionClient(const std::string& name, bool spin_thread = true) {
    init(nh_, name, spin_thread);
  }
  SimpleActionClient(ros::NodeHandle& n, const std::string& name, bool spin_thread = true) {
    init(n, name, spin_thread);
  }
  ~SimpleActionClient() {
    if (spinner_) {
      queue_.disable();
      spinner_->stop();
    }
    goal_.reset();
    client_.reset();
  }

  bool waitForServer(const ros::Duration& timeout = ros::Duration(0, 0)) const {
    return client_->waitForActionServerToStart(timeout);
  }
  bool isServerConnected() const { return client_->isServerConnected(); }

  void sendGoal(const Goal& goal, SimpleDoneCallback done_cb = SimpleDoneCallback(),
                SimpleActiveCallback active_cb = SimpleActiveCallback(),
                SimpleFeedbackCallback feedback_cb = SimpleFeedbackCallback()) {
    {
      const std::lock_guard<std::mutex> lock(shared_->mutex);
      shared_->done_cb = done_cb;
      shared_->active_cb = active_cb;
      shared_->feedback_cb = feedback_cb;
      shared_->state = SimpleGoalState::PENDING;
      ++shared_->number;
    }
    goal_.reset();
    const std::shared_ptr<Shared> shared = shared_;
    const unsigned number = shared_->number;
    goal_ = client_->sendGoal(
        goal, [shared, number](GoalHandleT handle) { shared->transition(handle, number); },
        [shared, number](GoalHandleT, const FeedbackConstPtr& feedback) {
          shared->feedback(feedback, number);
        });
  }
  SimpleClientGoalState sendGoalAndWait(const Goal& goal,
                                        const ros::Duration& execute_timeout = ros::Duration(0, 0),
                                        const ros::Duration& preempt_timeout = ros::Duration(0,
                                                                                             0)) {
    sendGoal(goal);
    if (waitForResult(execute_timeout)) return getState();
    cancelGoal();
    waitForResult(preempt_timeout);
    return getState();
  }
  bool waitForResult(const ros::Duration& timeout = ros::Duration(0, 0)) {
    if (goal_.isExpired()) {
      ROS_ERROR_NAMED("actionlib", "waitForResult() is called without a goal");
      return false;
    }
    const ros::Time end = ros::Time::now() + timeout;
    std::unique_lock<std::mutex> lock(shared_->mutex);
    while (nh_.ok() && shared_->state != SimpleGoalState::DONE) {
      if (!timeout.isZero() && ros::Time::now() >= end) break;
      // The clock may be simulated: a look at it now and then.
      shared_->done.wait_for(lock, std::chrono::milliseconds(10));
    }
    return shared_->state == SimpleGoalState::DONE;
  }
  ResultConstPtr getResult() const {
    return goal_.isExpired() ? ResultConstPtr() : goal_.getResult();
  }

  SimpleClientGoalState getState() const {
    if (goal_.isExpired()) {
      ROS_ERROR_NAMED("actionlib", "getState() is called without a goal");
      return SimpleClientGoalState(SimpleClientGoalState::LOST);
    }
    const CommState state = goal_.getCommState();
    switch (state.state_) {
      case CommState::WAITING_FOR_GOAL_ACK:
      case CommState::PENDING:
      case CommState::RECALLING:
        return SimpleClientGoalState(SimpleClientGoalState::PENDING);
      case CommState::ACTIVE:
      case CommState::PREEMPTING:
        return SimpleClientGoalState(SimpleClientGoalState::ACTIVE);
      case CommState::DONE:
        return Shared::finished(goal_);
      default: {
        const std::lock_guard<std::mutex> lock(shared_->mutex);
        return SimpleClientGoalState(shared_->state == SimpleGoalState::PENDING
                                         ? SimpleClientGoalState::PENDING
                                         : SimpleClientGoalState::ACTIVE);
      }
    }
  }
  void cancelAllGoals() { client_->cancelAllGoals(); }
  void cancelGoalsAtAndBeforeTime(const ros::Time& time) {
    client_->cancelGoalsAtAndBeforeTime(time);
  }
  void cancelGoal() {
    if (goal_.isExpired())
      ROS_ERROR_NAMED("actionlib", "cancelGoal() is called without a goal");
    else
      goal_.cancel();
  }
  void stopTrackingGoal() { goal_.reset(); }

 private:
  // What callbacks touch; it outlives a client that ends inside of one.
  struct Shared {
    std::mutex mutex;
    std::condition_variable done;
    SimpleGoalState state = SimpleGoalState(SimpleGoalState::PENDING);
    unsigned number = 0;
    SimpleDoneCallback done_cb;
    SimpleActiveCallback active_cb;
    SimpleFeedbackCallback feedback_cb;

    static SimpleClientGoalState finished(const GoalHandleT& goal) {
      const TerminalState end = goal.getTerminalState();
      switch (end.state_) {
        case TerminalState::RECALLED:
          return SimpleClientGoalState(SimpleClientGoalState::RECALLED, end.text_);
        case TerminalState::REJECTED:
          return SimpleClientGoalState(SimpleClientGoalState::REJECTED, end.text_);
        case TerminalState::PREEMPTED:
          return SimpleClientGoalState(SimpleClientGoalState::PREEMPTED, end.text_);
        case TerminalState::ABORTED:
          return SimpleClientGoalState(SimpleClientGoalState::ABORTED, end.text_);
        case TerminalState::SUCCEEDED:
          return SimpleClientGoalState(SimpleClientGoalState::SUCCEEDED, end.text_);
        case TerminalState::LOST:
          break;
      }
      return SimpleClientGoalState(SimpleClientGoalState::LOST, end.text_);
    }

    void transition(GoalHandleT handle, unsigned of_goal) {
      const CommState state = handle.getCommState();
      if (state == CommState::DONE) {
        SimpleDoneCallback callback;
        {
          const std::lock_guard<std::mutex> lock(mutex);
          if (number != of_goal || this->state == SimpleGoalState::DONE) return;
          callback = done_cb;
        }
        if (callback) callback(finished(handle), handle.getResult());
        const std::lock_guard<std::mutex> lock(mutex);
        if (number == of_goal) this->state = SimpleGoalState::DONE;
        done.notify_all();
      } else if (state == CommState::ACTIVE || state == CommState::PREEMPTING) {
        SimpleActiveCallback callback;
        {
          const std::lock_guard<std::mutex> lock(mutex);
          if (number != of_goal || this->state != SimpleGoalState::PENDING) return;
          this->state = SimpleGoalState::ACTIVE;
          callback = active_cb;
        }
        if (callback) callback();
      }
    }
    void feedback(const FeedbackConstPtr& message, unsigned of_goal) {
      SimpleFeedbackCallback callback;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (number != of_goal) return;
        callback = feedback_cb;
      }
      if (callback) callback(message);
    }
  };

  void init(ros::NodeHandle& n, const std::string& name, bool spin_thread) {
    client_ = std::make_unique<ActionClient<ActionSpec> >(n, name, spin_thread ? &queue_ : NULL);
    if (!spin_thread) return;
    spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
    spinner_->start();
  }

  ros::NodeHandle nh_;
  ros::CallbackQueue queue_;
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::unique_ptr<ActionClient<ActionSpec> > client_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  GoalHandleT goal_;
};

}  // namespace actionlib
