// Qualities of service: profiles, their words, and whether two of them fit.
#include "rclcpp/qos.hpp"

#include <cstring>
#include <sstream>

#include "gazelle/core.hpp"
#include "rclcpp/create_publisher.hpp"
#include "rclcpp/qos_overriding_options.hpp"

namespace {

template <class T>
struct Word {
  T value;
  const char* word;
};

constexpr Word<rmw_qos_policy_kind_t> kKinds[] = {
    {RMW_QOS_POLICY_DURABILITY, "durability"},
    {RMW_QOS_POLICY_DEADLINE, "deadline"},
    {RMW_QOS_POLICY_LIVELINESS, "liveliness"},
    {RMW_QOS_POLICY_RELIABILITY, "reliability"},
    {RMW_QOS_POLICY_HISTORY, "history"},
    {RMW_QOS_POLICY_LIFESPAN, "lifespan"},
    {RMW_QOS_POLICY_DEPTH, "depth"},
    {RMW_QOS_POLICY_LIVELINESS_LEASE_DURATION, "liveliness_lease_duration"},
    {RMW_QOS_POLICY_AVOID_ROS_NAMESPACE_CONVENTIONS, "avoid_ros_namespace_conventions"},
};
constexpr Word<rmw_qos_durability_policy_t> kDurabilities[] = {
    {RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT, "system_default"},
    {RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL, "transient_local"},
    {RMW_QOS_POLICY_DURABILITY_VOLATILE, "volatile"},
    {RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE, "best_available"},
};
constexpr Word<rmw_qos_history_policy_t> kHistories[] = {
    {RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT, "system_default"},
    {RMW_QOS_POLICY_HISTORY_KEEP_LAST, "keep_last"},
    {RMW_QOS_POLICY_HISTORY_KEEP_ALL, "keep_all"},
};
constexpr Word<rmw_qos_liveliness_policy_t> kLivelinesses[] = {
    {RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT, "system_default"},
    {RMW_QOS_POLICY_LIVELINESS_AUTOMATIC, "automatic"},
    {RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC, "manual_by_topic"},
    {RMW_QOS_POLICY_LIVELINESS_BEST_AVAILABLE, "best_available"},
};
constexpr Word<rmw_qos_reliability_policy_t> kReliabilities[] = {
    {RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT, "system_default"},
    {RMW_QOS_POLICY_RELIABILITY_RELIABLE, "reliable"},
    {RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT, "best_effort"},
    {RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE, "best_available"},
};

template <class T, std::size_t N>
const char* word_of(const Word<T> (&words)[N], T value) {
  for (const auto& one : words) {
    if (one.value == value) return one.word;
  }
  return nullptr;
}

template <class T, std::size_t N>
T value_of(const Word<T> (&words)[N], const char* text, T unknown) {
  for (const auto& one : words) {
    if (text && std::strcmp(one.word, text) == 0) return one.value;
  }
  return unknown;
}

}  // namespace

extern "C" {
const char* rmw_qos_policy_kind_to_str(rmw_qos_policy_kind_t kind) { return word_of(kKinds, kind); }
const char* rmw_qos_durability_policy_to_str(rmw_qos_durability_policy_t policy) {
  return word_of(kDurabilities, policy);
}
const char* rmw_qos_history_policy_to_str(rmw_qos_history_policy_t policy) {
  return word_of(kHistories, policy);
}
const char* rmw_qos_liveliness_policy_to_str(rmw_qos_liveliness_policy_t policy) {
  return word_of(kLivelinesses, policy);
}
const char* rmw_qos_reliability_policy_to_str(rmw_qos_reliability_policy_t policy) {
  return word_of(kReliabilities, policy);
}
rmw_qos_durability_policy_t rmw_qos_durability_policy_from_str(const char* text) {
  return value_of(kDurabilities, text, RMW_QOS_POLICY_DURABILITY_UNKNOWN);
}
rmw_qos_history_policy_t rmw_qos_history_policy_from_str(const char* text) {
  return value_of(kHistories, text, RMW_QOS_POLICY_HISTORY_UNKNOWN);
}
rmw_qos_liveliness_policy_t rmw_qos_liveliness_policy_from_str(const char* text) {
  return value_of(kLivelinesses, text, RMW_QOS_POLICY_LIVELINESS_UNKNOWN);
}
rmw_qos_reliability_policy_t rmw_qos_reliability_policy_from_str(const char* text) {
  return value_of(kReliabilities, text, RMW_QOS_POLICY_RELIABILITY_UNKNOWN);
}
}

namespace rclcpp {
namespace {

rmw_qos_profile_t with_history(rmw_qos_profile_t profile, const QoSInitialization& given) {
  profile.history = given.history_policy;
  profile.depth = given.depth;
  return profile;
}

// The graph knows no end of a duration as 0.
std::int64_t limit_ns(const rmw_time_t& time) {
  const std::int64_t ns = rmw_time_total_nsec(time);
  return ns >= std::numeric_limits<std::int64_t>::max() - 1 ? 0 : ns;
}

}  // namespace

std::string qos_policy_name_from_kind(rmw_qos_policy_kind_t kind) {
  static const std::pair<rmw_qos_policy_kind_t, const char*> kNames[] = {
      {RMW_QOS_POLICY_DURABILITY, "DURABILITY_QOS_POLICY"},
      {RMW_QOS_POLICY_DEADLINE, "DEADLINE_QOS_POLICY"},
      {RMW_QOS_POLICY_LIVELINESS, "LIVELINESS_QOS_POLICY"},
      {RMW_QOS_POLICY_RELIABILITY, "RELIABILITY_QOS_POLICY"},
      {RMW_QOS_POLICY_HISTORY, "HISTORY_QOS_POLICY"},
      {RMW_QOS_POLICY_LIFESPAN, "LIFESPAN_QOS_POLICY"},
  };
  for (const auto& one : kNames) {
    if (one.first == kind) return one.second;
  }
  return "INVALID_QOS_POLICY";
}

QoSInitialization QoSInitialization::from_rmw(const rmw_qos_profile_t& profile) {
  switch (profile.history) {
    case RMW_QOS_POLICY_HISTORY_KEEP_ALL:
      return KeepAll();
    case RMW_QOS_POLICY_HISTORY_KEEP_LAST:
    case RMW_QOS_POLICY_HISTORY_SYSTEM_DEFAULT:
    case RMW_QOS_POLICY_HISTORY_UNKNOWN:
    default:
      return KeepLast(profile.depth, false);
  }
}

QoS::QoS(const QoSInitialization& initialization, const rmw_qos_profile_t& profile)
    : profile_(with_history(profile, initialization)) {}
QoS::QoS(std::size_t history_depth) : QoS(KeepLast(history_depth)) {}

QoS& QoS::history(HistoryPolicy history) {
  return this->history(static_cast<rmw_qos_history_policy_t>(history));
}
QoS& QoS::history(rmw_qos_history_policy_t history) {
  profile_.history = history;
  return *this;
}
QoS& QoS::keep_last(std::size_t depth) {
  profile_.depth = depth;
  return history(RMW_QOS_POLICY_HISTORY_KEEP_LAST);
}
QoS& QoS::keep_all() {
  profile_.depth = 0;
  return history(RMW_QOS_POLICY_HISTORY_KEEP_ALL);
}
QoS& QoS::reliability(rmw_qos_reliability_policy_t reliability) {
  profile_.reliability = reliability;
  return *this;
}
QoS& QoS::reliability(ReliabilityPolicy reliability) {
  return this->reliability(static_cast<rmw_qos_reliability_policy_t>(reliability));
}
QoS& QoS::reliable() { return reliability(RMW_QOS_POLICY_RELIABILITY_RELIABLE); }
QoS& QoS::best_effort() { return reliability(RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT); }
QoS& QoS::reliability_best_available() {
  return reliability(RMW_QOS_POLICY_RELIABILITY_BEST_AVAILABLE);
}
QoS& QoS::durability(rmw_qos_durability_policy_t durability) {
  profile_.durability = durability;
  return *this;
}
QoS& QoS::durability(DurabilityPolicy durability) {
  return this->durability(static_cast<rmw_qos_durability_policy_t>(durability));
}
QoS& QoS::durability_volatile() { return durability(RMW_QOS_POLICY_DURABILITY_VOLATILE); }
QoS& QoS::transient_local() { return durability(RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL); }
QoS& QoS::durability_best_available() {
  return durability(RMW_QOS_POLICY_DURABILITY_BEST_AVAILABLE);
}
QoS& QoS::deadline(rmw_time_t deadline) {
  profile_.deadline = deadline;
  return *this;
}
QoS& QoS::deadline(const Duration& deadline) { return this->deadline(deadline.to_rmw_time()); }
QoS& QoS::lifespan(rmw_time_t lifespan) {
  profile_.lifespan = lifespan;
  return *this;
}
QoS& QoS::lifespan(const Duration& lifespan) { return this->lifespan(lifespan.to_rmw_time()); }
QoS& QoS::liveliness(rmw_qos_liveliness_policy_t liveliness) {
  profile_.liveliness = liveliness;
  return *this;
}
QoS& QoS::liveliness(LivelinessPolicy liveliness) {
  return this->liveliness(static_cast<rmw_qos_liveliness_policy_t>(liveliness));
}
QoS& QoS::liveliness_lease_duration(rmw_time_t lease) {
  profile_.liveliness_lease_duration = lease;
  return *this;
}
QoS& QoS::liveliness_lease_duration(const Duration& lease) {
  return liveliness_lease_duration(lease.to_rmw_time());
}
QoS& QoS::avoid_ros_namespace_conventions(bool avoid) {
  profile_.avoid_ros_namespace_conventions = avoid;
  return *this;
}

HistoryPolicy QoS::history() const { return static_cast<HistoryPolicy>(profile_.history); }
ReliabilityPolicy QoS::reliability() const {
  return static_cast<ReliabilityPolicy>(profile_.reliability);
}
DurabilityPolicy QoS::durability() const {
  return static_cast<DurabilityPolicy>(profile_.durability);
}
Duration QoS::deadline() const { return Duration::from_rmw_time(profile_.deadline); }
Duration QoS::lifespan() const { return Duration::from_rmw_time(profile_.lifespan); }
LivelinessPolicy QoS::liveliness() const {
  return static_cast<LivelinessPolicy>(profile_.liveliness);
}
Duration QoS::liveliness_lease_duration() const {
  return Duration::from_rmw_time(profile_.liveliness_lease_duration);
}

gazelle::Qos QoS::to_graph() const {
  gazelle::Qos qos;
  qos.keep_all = profile_.history == RMW_QOS_POLICY_HISTORY_KEEP_ALL;
  // A depth of 0 with the system's history leaves the choice to the transport.
  qos.depth = profile_.depth ? profile_.depth : 10;
  qos.reliable = profile_.reliability != RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT;
  qos.transient_local = profile_.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  qos.deadline_ns = limit_ns(profile_.deadline);
  qos.lifespan_ns = limit_ns(profile_.lifespan);
  qos.manual_liveliness = profile_.liveliness == RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC;
  qos.lease_ns = limit_ns(profile_.liveliness_lease_duration);
  return qos;
}

bool operator==(const QoS& left, const QoS& right) {
  const auto& a = left.get_rmw_qos_profile();
  const auto& b = right.get_rmw_qos_profile();
  return a.history == b.history && a.depth == b.depth && a.reliability == b.reliability &&
         a.durability == b.durability && rmw_time_equal(a.deadline, b.deadline) &&
         rmw_time_equal(a.lifespan, b.lifespan) && a.liveliness == b.liveliness &&
         rmw_time_equal(a.liveliness_lease_duration, b.liveliness_lease_duration) &&
         a.avoid_ros_namespace_conventions == b.avoid_ros_namespace_conventions;
}

bool operator!=(const QoS& left, const QoS& right) { return !(left == right); }

QoSCheckCompatibleResult qos_check_compatible(const QoS& publisher_qos,
                                              const QoS& subscription_qos) {
  const auto& offered = publisher_qos.get_rmw_qos_profile();
  const auto& wanted = subscription_qos.get_rmw_qos_profile();
  std::string errors;
  if (offered.reliability == RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT &&
      wanted.reliability == RMW_QOS_POLICY_RELIABILITY_RELIABLE) {
    errors += "ERROR: Best effort publisher and reliable subscription;";
  }
  if (offered.durability == RMW_QOS_POLICY_DURABILITY_VOLATILE &&
      wanted.durability == RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL) {
    errors += "ERROR: Volatile publisher and transient local subscription;";
  }
  const std::int64_t offered_deadline = limit_ns(offered.deadline);
  const std::int64_t wanted_deadline = limit_ns(wanted.deadline);
  if (wanted_deadline && !offered_deadline) {
    errors += "ERROR: Subscription has a deadline, but publisher does not;";
  } else if (wanted_deadline && wanted_deadline < offered_deadline) {
    errors += "ERROR: Subscription deadline is less than publisher deadline;";
  }
  if (offered.liveliness == RMW_QOS_POLICY_LIVELINESS_AUTOMATIC &&
      wanted.liveliness == RMW_QOS_POLICY_LIVELINESS_MANUAL_BY_TOPIC) {
    errors += "ERROR: Publisher's liveliness is automatic and subscription's is manual by topic;";
  }
  const std::int64_t offered_lease = limit_ns(offered.liveliness_lease_duration);
  const std::int64_t wanted_lease = limit_ns(wanted.liveliness_lease_duration);
  if (wanted_lease && !offered_lease) {
    errors += "ERROR: Subscription has a liveliness lease duration, but publisher does not;";
  } else if (wanted_lease && wanted_lease < offered_lease) {
    errors +=
        "ERROR: Subscription liveliness lease duration is less than publisher liveliness lease "
        "duration;";
  }
  if (!errors.empty()) return {QoSCompatibility::Error, errors};
  const bool unsure = offered.reliability == RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT ||
                      wanted.reliability == RMW_QOS_POLICY_RELIABILITY_SYSTEM_DEFAULT ||
                      offered.durability == RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT ||
                      wanted.durability == RMW_QOS_POLICY_DURABILITY_SYSTEM_DEFAULT;
  if (unsure) {
    return {QoSCompatibility::Warning, "WARNING: a policy is left to the transport;"};
  }
  return {QoSCompatibility::Ok, ""};
}

// ---- Parameters that override policies ----------------------------------------------------------

const char* qos_policy_kind_to_cstr(const QosPolicyKind& kind) {
  const char* word = rmw_qos_policy_kind_to_str(static_cast<rmw_qos_policy_kind_t>(kind));
  if (!word) throw std::invalid_argument("unknown QoS policy kind");
  return word;
}

std::ostream& operator<<(std::ostream& out, const QosPolicyKind& kind) {
  return out << qos_policy_kind_to_cstr(kind);
}

namespace detail {
namespace {

ParameterValue value_of_policy(QosPolicyKind kind, const QoS& qos) {
  const auto& profile = qos.get_rmw_qos_profile();
  const auto ns = [](const rmw_time_t& time) {
    return ParameterValue(static_cast<int64_t>(rmw_time_total_nsec(time)));
  };
  switch (kind) {
    case QosPolicyKind::AvoidRosNamespaceConventions:
      return ParameterValue(profile.avoid_ros_namespace_conventions);
    case QosPolicyKind::Deadline:
      return ns(profile.deadline);
    case QosPolicyKind::Depth:
      return ParameterValue(static_cast<int64_t>(profile.depth));
    case QosPolicyKind::Durability:
      return ParameterValue(rmw_qos_durability_policy_to_str(profile.durability));
    case QosPolicyKind::History:
      return ParameterValue(rmw_qos_history_policy_to_str(profile.history));
    case QosPolicyKind::Lifespan:
      return ns(profile.lifespan);
    case QosPolicyKind::Liveliness:
      return ParameterValue(rmw_qos_liveliness_policy_to_str(profile.liveliness));
    case QosPolicyKind::LivelinessLeaseDuration:
      return ns(profile.liveliness_lease_duration);
    case QosPolicyKind::Reliability:
      return ParameterValue(rmw_qos_reliability_policy_to_str(profile.reliability));
    case QosPolicyKind::Invalid:
      break;
  }
  throw std::invalid_argument("invalid QoS policy kind");
}

template <class T>
T known(T value, T unknown, const std::string& word) {
  if (value == unknown) throw std::invalid_argument("unknown QoS policy value: " + word);
  return value;
}

void apply_policy(QosPolicyKind kind, const ParameterValue& value, QoS& qos) {
  const auto time = [&value]() { return rmw_time_from_nsec(value.get<int64_t>()); };
  const std::string word = value.get_type() == PARAMETER_STRING ? value.get<std::string>() : "";
  switch (kind) {
    case QosPolicyKind::AvoidRosNamespaceConventions:
      qos.avoid_ros_namespace_conventions(value.get<bool>());
      return;
    case QosPolicyKind::Deadline:
      qos.deadline(time());
      return;
    case QosPolicyKind::Depth:
      qos.get_rmw_qos_profile().depth = static_cast<std::size_t>(value.get<int64_t>());
      return;
    case QosPolicyKind::Durability:
      qos.durability(known(rmw_qos_durability_policy_from_str(word.c_str()),
                           RMW_QOS_POLICY_DURABILITY_UNKNOWN, word));
      return;
    case QosPolicyKind::History:
      qos.history(known(rmw_qos_history_policy_from_str(word.c_str()),
                        RMW_QOS_POLICY_HISTORY_UNKNOWN, word));
      return;
    case QosPolicyKind::Lifespan:
      qos.lifespan(time());
      return;
    case QosPolicyKind::Liveliness:
      qos.liveliness(known(rmw_qos_liveliness_policy_from_str(word.c_str()),
                           RMW_QOS_POLICY_LIVELINESS_UNKNOWN, word));
      return;
    case QosPolicyKind::LivelinessLeaseDuration:
      qos.liveliness_lease_duration(time());
      return;
    case QosPolicyKind::Reliability:
      qos.reliability(known(rmw_qos_reliability_policy_from_str(word.c_str()),
                            RMW_QOS_POLICY_RELIABILITY_UNKNOWN, word));
      return;
    case QosPolicyKind::Invalid:
      break;
  }
  throw std::invalid_argument("invalid QoS policy kind");
}

}  // namespace

QoS overridden_qos(node_interfaces::NodeParametersInterface* parameters, const std::string& topic,
                   const QoS& qos, const QosOverridingOptions& options, bool is_publisher) {
  if (!parameters) return qos;
  QoS actual = qos;
  std::string entity = is_publisher ? "publisher" : "subscription";
  if (!options.get_id().empty()) entity += "_" + options.get_id();
  for (const auto kind : options.get_policy_kinds()) {
    const std::string name =
        "qos_overrides." + topic + "." + entity + "." + qos_policy_kind_to_cstr(kind);
    rcl_interfaces::msg::ParameterDescriptor descriptor;
    descriptor.description = "qos policy {" + std::string(qos_policy_kind_to_cstr(kind)) +
                             "} for {" + entity + "} on topic {" + topic + "}";
    descriptor.read_only = true;
    ParameterValue value;
    if (parameters->has_parameter(name)) {
      value = parameters->get_parameter(name).get_parameter_value();
    } else {
      value = parameters->declare_parameter(name, value_of_policy(kind, qos), descriptor);
    }
    apply_policy(kind, value, actual);
  }
  if (const auto& validate = options.get_validation_callback()) {
    const auto result = validate(actual);
    if (!result.successful) {
      throw exceptions::InvalidParameterValueException("validation callback failed: " +
                                                       result.reason);
    }
  }
  return actual;
}

}  // namespace detail
}  // namespace rclcpp
