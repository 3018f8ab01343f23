#pragma once

#include <string>

namespace actionlib {

/// What getState() of a simple client tells.
class SimpleClientGoalState {
 public:
  enum StateEnum { PENDING, ACTIVE, RECALLED, REJECTED, PREEMPTED, ABORTED, SUCCEEDED, LOST };
  StateEnum state_;
  std::string text_;

  SimpleClientGoalState(const StateEnum& state, const std::string& text = std::string(""))
      : state_(state), text_(text) {}
  inline bool operator==(const SimpleClientGoalState& other) const {
    return state_ == other.state_;
  }
  inline bool operator==(const StateEnum& other) const { return state_ == other; }
  inline bool operator!=(const StateEnum& other) const { return state_ != other; }
  inline bool operator!=(const SimpleClientGoalState& other) const {
    return state_ != other.state_;
  }
  inline bool isDone() const { return state_ != PENDING && state_ != ACTIVE; }
  std::string getText() const { return text_; }
  std::string toString() const {
    static const char* const kNames[] = {"PENDING",   "ACTIVE",  "RECALLED",  "REJECTED",
                                         "PREEMPTED", "ABORTED", "SUCCEEDED", "LOST"};
    return kNames[state_];
  }
};

}  // namespace actionlib
