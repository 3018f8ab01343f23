#pragma once

#include <string>

namespace actionlib {

/// What a simple client knows of its goal.
class SimpleGoalState {
 public:
  enum StateEnum { PENDING, ACTIVE, DONE };
  StateEnum state_;

  SimpleGoalState(const StateEnum& state) : state_(state) {}
  inline bool operator==(const SimpleGoalState& other) const { return state_ == other.state_; }
  inline bool operator==(const StateEnum& other) const { return state_ == other; }
  inline bool operator!=(const StateEnum& other) const { return state_ != other; }
  inline bool operator!=(const SimpleGoalState& other) const { return state_ != other.state_; }
  std::string toString() const {
    return state_ == PENDING ? "PENDING" : state_ == ACTIVE ? "ACTIVE" : "DONE";
  }
};

}  // namespace actionlib
