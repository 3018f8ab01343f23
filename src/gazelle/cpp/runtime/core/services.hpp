// Services' ends in this process.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <unordered_map>

#include "gazelle/core.hpp"

namespace gazelle {

class ServerEnd final : public ServiceServer, public std::enable_shared_from_this<ServerEnd> {
 public:
  explicit ServerEnd(std::function<void(RequestId, Bytes)> handler)
      : handler_(std::move(handler)) {}
  ~ServerEnd() override { close(); }

  void open(Json request);

  void respond(const RequestId& request, Bytes response) override;
  void fail(const RequestId& request, const std::string& text) override;
  const std::string& name() const override { return name_; }
  void close() override;

  void take(RequestId request, Bytes bytes);

 private:
  std::function<void(RequestId, Bytes)> handler_;
  std::string name_;
  std::uint64_t number_ = 0;
  std::uint64_t handle_ = 0;
  std::atomic<bool> closed_{true};
};

class ClientEnd final : public ServiceClient, public std::enable_shared_from_this<ClientEnd> {
 public:
  ~ClientEnd() override { close(); }

  void open(Json request);

  std::int64_t call_async(Bytes request, std::function<void(CallResult)> done,
                          double timeout_s) override;
  void cancel(std::int64_t number) override;
  CallResult call(Bytes request, double timeout_s) override;
  bool is_ready() const override;
  bool wait_for(double timeout_s) override;
  const std::string& name() const override { return name_; }
  void close() override;

 private:
  std::string name_;
  std::uint64_t handle_ = 0;
  std::atomic<bool> closed_{true};
  std::mutex mutex_;
  std::int64_t last_ = 0;
  std::unordered_map<std::int64_t, std::uint64_t> under_way_;  // by own number: the process's
};

}  // namespace gazelle
