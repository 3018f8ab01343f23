#pragma once

#include <actionlib/action_definition.h>
#include <actionlib/enclosure_deleter.h>
#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/console.h>

#include <boost/shared_ptr.hpp>
#include <boost/weak_ptr.hpp>
#include <string>

namespace actionlib {

template <class ActionSpec>
class ActionServerBase;

namespace detail {

/// A goal as its server keeps it.
template <class ActionSpec>
struct ServerGoal {
  boost::shared_ptr<const typename ActionSpec::_action_goal_type> goal;
  actionlib_msgs::GoalStatus status;
  boost::weak_ptr<void> hold;  // what all handles of it share
  ros::Time released;          // when the last handle went; zero: it is there
};

template <class ActionSpec>
struct ServerCore;

}  // namespace detail

/// A server's hold of a goal.
template <class ActionSpec>
class ServerGoalHandle {
 private:
  ACTION_DEFINITION(ActionSpec)
  typedef detail::ServerCore<ActionSpec> Core;
  typedef boost::shared_ptr<detail::ServerGoal<ActionSpec> > GoalPtr;

 public:
  ServerGoalHandle() {}
  ServerGoalHandle(const boost::shared_ptr<Core>& core, const GoalPtr& goal,
                   const boost::shared_ptr<void>& hold)
      : core_(core), goal_(goal), hold_(hold) {}

  void setAccepted(const std::string& text = std::string("")) {
    typedef actionlib_msgs::GoalStatus S;
    change("accept", text, Result(), {{S::PENDING, S::ACTIVE}, {S::RECALLING, S::PREEMPTING}});
  }
  void setCanceled(const Result& result = Result(), const std::string& text = std::string("")) {
    typedef actionlib_msgs::GoalStatus S;
    change("cancel", text, result,
           {{S::PENDING, S::RECALLED},
            {S::RECALLING, S::RECALLED},
            {S::ACTIVE, S::PREEMPTED},
            {S::PREEMPTING, S::PREEMPTED}});
  }
  void setRejected(const Result& result = Result(), const std::string& text = std::string("")) {
    typedef actionlib_msgs::GoalStatus S;
    change("reject", text, result, {{S::PENDING, S::REJECTED}, {S::RECALLING, S::REJECTED}});
  }
  void setAborted(const Result& result = Result(), const std::string& text = std::string("")) {
    typedef actionlib_msgs::GoalStatus S;
    change("abort", text, result, {{S::PREEMPTING, S::ABORTED}, {S::ACTIVE, S::ABORTED}});
  }
  void setSucceeded(const Result& result = Result(), const std::string& text = std::string("")) {
    typedef actionlib_msgs::GoalStatus S;
    change("succeed", text, result, {{S::PREEMPTING, S::SUCCEEDED}, {S::ACTIVE, S::SUCCEEDED}});
  }
  void publishFeedback(const Feedback& feedback);
  bool isValid() const { return goal_ && core_.lock(); }

  GoalConstPtr getGoal() const {
    return goal_ ? share_member(goal_->goal, goal_->goal->goal) : GoalConstPtr();
  }
  actionlib_msgs::GoalID getGoalID() const {
    return goal_ ? goal_->status.goal_id : actionlib_msgs::GoalID();
  }
  actionlib_msgs::GoalStatus getGoalStatus() const;

  bool operator==(const ServerGoalHandle& other) const { return goal_ == other.goal_; }
  bool operator!=(const ServerGoalHandle& other) const { return goal_ != other.goal_; }

 private:
  struct Step {
    uint8_t from, to;
  };
  void change(const char* what, const std::string& text, const Result& result,
              std::initializer_list<Step> steps);

  boost::weak_ptr<Core> core_;
  GoalPtr goal_;
  boost::shared_ptr<void> hold_;
};

}  // namespace actionlib
