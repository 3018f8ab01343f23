#include "services.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "host.hpp"
#include "registry.hpp"

namespace gazelle {

namespace {

constexpr std::int64_t kLookNs = 100'000'000;

Registry<ServerEnd>& servers() {
  static auto* all = new Registry<ServerEnd>;
  return *all;
}

// Calls that have no answer yet, of all clients.
struct Calls {
  std::mutex mutex;
  std::unordered_map<std::uint64_t, std::function<void(CallResult)>> waiting;
  std::uint64_t last = 0;

  std::uint64_t add(std::function<void(CallResult)> done) {
    std::lock_guard lock(mutex);
    waiting.emplace(++last, std::move(done));
    return last;
  }

  std::function<void(CallResult)> take(std::uint64_t number) {
    std::lock_guard lock(mutex);
    const auto found = waiting.find(number);
    if (found == waiting.end()) return {};
    auto done = std::move(found->second);
    waiting.erase(found);
    return done;
  }
};

Calls& calls() {
  static auto* all = new Calls;
  return *all;
}

}  // namespace

// ---- Servers ------------------------------------------------------------------------------------

void ServerEnd::open(Json request) {
  number_ = servers().add(weak_from_this());
  request.set("core", number_);
  closed_ = false;
  Json made;
  try {
    made = gazelle::call("service/offer", request);
  } catch (...) {
    closed_ = true;
    throw;
  }
  closed_ = made.is_null();
  handle_ = static_cast<std::uint64_t>(made["handle"].as_int());
  name_ = made["name"].as_string();
}

void ServerEnd::take(RequestId request, Bytes bytes) {
  if (closed_) {
    fail(request, "the service was shut down");
  } else {
    handler_(std::move(request), std::move(bytes));
  }
}

void ServerEnd::respond(const RequestId& request, Bytes response) {
  if (const gazelle_host* host = host::table()) {
    host->respond(request.number, 0, response.data(), response.size());
  }
}

void ServerEnd::fail(const RequestId& request, const std::string& text) {
  if (const gazelle_host* host = host::table()) {
    host->respond(request.number, 1, reinterpret_cast<const std::uint8_t*>(text.data()),
                  text.size());
  }
}

void ServerEnd::close() {
  servers().remove(number_);
  if (closed_.exchange(true)) return;
  host::call_at_end("end/close", Json::object({{"handle", handle_}}));
}

// ---- Clients ------------------------------------------------------------------------------------

void ClientEnd::open(Json request) {
  const Json made = gazelle::call("service/client", request);
  if (made.is_null()) return;
  handle_ = static_cast<std::uint64_t>(made["handle"].as_int());
  name_ = made["name"].as_string();
  closed_ = false;
}

std::int64_t ClientEnd::call_async(Bytes request, std::function<void(CallResult)> done,
                                   double timeout_s) {
  std::int64_t own;
  std::uint64_t number;
  {
    std::lock_guard lock(mutex_);
    own = ++last_;
    std::weak_ptr<ClientEnd> self = weak_from_this();
    number = calls().add([self, own, done = std::move(done)](CallResult result) {
      if (const auto client = self.lock()) {
        std::lock_guard forget(client->mutex_);
        client->under_way_.erase(own);
      }
      done(std::move(result));
    });
    under_way_[own] = number;
  }
  const gazelle_host* host = closed_ ? nullptr : host::table();
  int status = GAZELLE_CLOSED;
  if (host != nullptr) {
    host::SignalsBlocked quiet;
    status = host->request(handle_, number, request.data(), request.size(), timeout_s, 0);
  }
  if (status != GAZELLE_OK) {
    if (const auto failed = calls().take(number)) {
      failed({CallStatus::kUnavailable, {}, "service [" + name_ + "]: the graph was left", 0});
    }
  }
  return own;
}

void ClientEnd::cancel(std::int64_t number) {
  std::uint64_t all = 0;
  {
    std::lock_guard lock(mutex_);
    const auto found = under_way_.find(number);
    if (found == under_way_.end()) return;
    all = found->second;
    under_way_.erase(found);
  }
  calls().take(all);
}

CallResult ClientEnd::call(Bytes request, double timeout_s) {
  std::optional<CallResult> found;
  const gazelle_host* host = closed_ ? nullptr : host::table();
  if (host != nullptr) {
    const std::uint64_t number =
        calls().add([&found](CallResult result) { found = std::move(result); });
    host->request(handle_, number, request.data(), request.size(), timeout_s, 1);
    calls().take(number);
  }
  if (found) return std::move(*found);
  return {CallStatus::kUnavailable, {}, "service [" + name_ + "]: the graph was left", 0};
}

bool ClientEnd::is_ready() const {
  return !closed_ &&
         gazelle::call("service/is_ready", Json::object({{"handle", handle_}})).as_bool();
}

bool ClientEnd::wait_for(double timeout_s) {
  const std::int64_t end =
      timeout_s < 0.0 ? INT64_MAX : clock::steady_ns() + static_cast<std::int64_t>(timeout_s * 1e9);
  // In slices: the process may come to its end meanwhile.
  while (!closed_) {
    const std::int64_t left = std::max<std::int64_t>(end - clock::steady_ns(), 0);
    const double slice_s = static_cast<double>(std::min(left, kLookNs)) * 1e-9;
    const Json answer =
        gazelle::call("service/wait", Json::object({{"handle", handle_}, {"timeout_s", slice_s}}));
    if (answer.as_bool()) return true;
    if (left <= kLookNs || !ok() || answer.is_null()) return false;
  }
  return false;
}

void ClientEnd::close() {
  if (closed_.exchange(true)) return;
  {
    std::lock_guard lock(mutex_);
    for (const auto& one : under_way_) calls().take(one.second);
    under_way_.clear();
  }
  host::call_at_end("end/close", Json::object({{"handle", handle_}}));
}

}  // namespace gazelle

extern "C" {

GAZELLE_EXPORT void gazelle_on_request(std::uint64_t server, std::uint64_t request,
                                       const std::uint8_t* cdr, std::size_t size, void* owner,
                                       const std::uint8_t* client, std::int64_t sequence,
                                       std::int64_t stamp_ns, const char* caller) {
  using namespace gazelle;  // NOLINT: the whole of it is ours
  Bytes bytes = host::lent(cdr, size, owner);
  RequestId id;
  std::copy(client, client + id.client.size(), id.client.begin());
  id.sequence = sequence;
  id.stamp_ns = stamp_ns;
  id.caller = caller;
  id.number = request;
  if (const auto end = servers().find(server)) {
    end->take(std::move(id), std::move(bytes));
  } else if (const gazelle_host* host = host::table()) {
    static constexpr char kText[] = "the service was shut down";
    host->respond(request, 1, reinterpret_cast<const std::uint8_t*>(kText), sizeof kText - 1);
  }
}

GAZELLE_EXPORT void gazelle_on_response(std::uint64_t call, int status, const std::uint8_t* data,
                                        std::size_t size, void* owner, std::int64_t sequence,
                                        std::int64_t stamp_ns) {
  using namespace gazelle;  // NOLINT
  (void)sequence;
  Bytes bytes = host::lent(data, size, owner);
  const auto done = calls().take(call);
  if (!done) return;
  CallResult result;
  result.status = static_cast<CallStatus>(status);
  result.stamp_ns = stamp_ns;
  if (status == 0) {
    result.response = std::move(bytes);
  } else {
    result.text.assign(reinterpret_cast<const char*>(data), size);
  }
  done(std::move(result));
}

}  // extern "C"
