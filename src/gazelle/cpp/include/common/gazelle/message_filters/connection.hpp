// A registration that can be taken back.
#pragma once

#include <functional>

namespace message_filters {

class Connection {
 public:
  Connection() = default;
  Connection(std::function<void()> disconnect) : disconnect_(std::move(disconnect)) {}  // NOLINT

  void disconnect() {
    if (disconnect_) disconnect_();
    disconnect_ = nullptr;
  }

 private:
  std::function<void()> disconnect_;
};

}  // namespace message_filters
