#pragma once

#include <string>

namespace actionlib {

/// How a goal ended.
class TerminalState {
 public:
  enum StateEnum { RECALLED, REJECTED, PREEMPTED, ABORTED, SUCCEEDED, LOST };

  TerminalState(const StateEnum& state, const std::string& text = std::string(""))
      : state_(state), text_(text) {}
  inline bool operator==(const TerminalState& other) const { return state_ == other.state_; }
  inline bool operator==(const StateEnum& other) const { return state_ == other; }
  inline bool operator!=(const TerminalState::StateEnum& other) const { return state_ != other; }
  inline bool operator!=(const TerminalState& other) const { return state_ != other.state_; }
  std::string getText() const { return text_; }
  std::string toString() const {
    static const char* const kNames[] = {"RECALLED", "REJECTED",  "PREEMPTED",
                                         "ABORTED",  "SUCCEEDED", "LOST"};
    return kNames[state_];
  }

  StateEnum state_;
  std::string text_;
};

}  // namespace actionlib
