// What dynamic_reconfigure does by the table of a configuration class, compiled once.
#include <gazelle/reconfigure.hpp>
#include <utility>

namespace gazelle {
namespace reconfigure {
namespace {

template <class T>
T& at(void* config, std::size_t offset) {
  return *reinterpret_cast<T*>(static_cast<char*>(config) + offset);
}
template <class T>
const T& at(const void* config, std::size_t offset) {
  return *reinterpret_cast<const T*>(static_cast<const char*>(config) + offset);
}

const char* type_name(Type type) {
  switch (type) {
    case Type::boolean:
      return "bool";
    case Type::integer:
      return "int";
    case Type::real:
      return "double";
    default:
      return "str";
  }
}

}  // namespace

void set_all(const Table& table, void* config, Which which) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    const double value = which == Which::usual    ? row.value
                         : which == Which::lowest ? row.lowest
                                                  : row.highest;
    switch (row.type) {
      case Type::boolean:
        at<bool>(config, row.offset) = value != 0;
        break;
      case Type::integer:
        at<int>(config, row.offset) = static_cast<int>(value);
        break;
      case Type::real:
        at<double>(config, row.offset) = value;
        break;
      case Type::text:
        at<std::string>(config, row.offset) = which == Which::usual    ? row.text
                                              : which == Which::lowest ? row.lowest_text
                                                                       : row.highest_text;
        break;
    }
  }
  for (std::size_t i = 0; i < table.group_count; ++i) {
    at<bool>(config, table.groups[i].state) = table.groups[i].is_unfolded;
  }
}

void clamp(const Table& table, void* config) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    if (row.type == Type::integer) {
      int& value = at<int>(config, row.offset);
      value = value > row.highest ? static_cast<int>(row.highest) : value;
      value = value < row.lowest ? static_cast<int>(row.lowest) : value;
    } else if (row.type == Type::real) {
      double& value = at<double>(config, row.offset);
      value = value > row.highest ? row.highest : value;
      value = value < row.lowest ? row.lowest : value;
    }
  }
}

std::uint32_t level(const Table& table, const void* one, const void* other) {
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    bool is_same = true;
    switch (row.type) {
      case Type::boolean:
        is_same = at<bool>(one, row.offset) == at<bool>(other, row.offset);
        break;
      case Type::integer:
        is_same = at<int>(one, row.offset) == at<int>(other, row.offset);
        break;
      case Type::real:
        is_same = at<double>(one, row.offset) == at<double>(other, row.offset);
        break;
      case Type::text:
        is_same = at<std::string>(one, row.offset) == at<std::string>(other, row.offset);
        break;
    }
    if (!is_same) {
      found |= row.level;
    }
  }
  return found;
}

void to_message(const Table& table, const void* config, dynamic_reconfigure::Config& message) {
  using dynamic_reconfigure::ConfigTools;
  ConfigTools::clear(message);
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    switch (row.type) {
      case Type::boolean:
        ConfigTools::appendParameter(message, row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        ConfigTools::appendParameter(message, row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        ConfigTools::appendParameter(message, row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        ConfigTools::appendParameter(message, row.name, at<std::string>(config, row.offset));
        break;
    }
  }
  for (std::size_t i = 0; i < table.group_count; ++i) {
    const Group& group = table.groups[i];
    dynamic_reconfigure::GroupState state;
    state.name = group.name;
    state.state = at<bool>(config, group.state);
    state.id = static_cast<int>(i);
    state.parent = group.parent;
    message.groups.push_back(state);
  }
}

bool from_message(const Table& table, void* config, const dynamic_reconfigure::Config& message) {
  using dynamic_reconfigure::ConfigTools;
  std::size_t count = 0;
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    bool is_there = false;
    switch (row.type) {
      case Type::boolean:
        is_there = ConfigTools::getParameter(message, row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        is_there = ConfigTools::getParameter(message, row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        is_there = ConfigTools::getParameter(message, row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        is_there =
            ConfigTools::getParameter(message, row.name, at<std::string>(config, row.offset));
        break;
    }
    count += is_there ? 1 : 0;
  }
  for (const dynamic_reconfigure::GroupState& state : message.groups) {
    for (std::size_t i = 0; i < table.group_count; ++i) {
      if (state.name == table.groups[i].name) {
        at<bool>(config, table.groups[i].state) = state.state != 0;
      }
    }
  }
  return count == ConfigTools::size(message);
}

void to_server(const Table& table, const void* config, const ros::NodeHandle& node) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    switch (row.type) {
      case Type::boolean:
        node.setParam(row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        node.setParam(row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        node.setParam(row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        node.setParam(row.name, at<std::string>(config, row.offset));
        break;
    }
  }
}

void from_server(const Table& table, void* config, const ros::NodeHandle& node) {
  for (std::size_t i = 0; i < table.parameter_count; ++i) {
    const Parameter& row = table.parameters[i];
    switch (row.type) {
      case Type::boolean:
        node.getParam(row.name, at<bool>(config, row.offset));
        break;
      case Type::integer:
        node.getParam(row.name, at<int>(config, row.offset));
        break;
      case Type::real:
        node.getParam(row.name, at<double>(config, row.offset));
        break;
      case Type::text:
        node.getParam(row.name, at<std::string>(config, row.offset));
        break;
    }
  }
}

void describe(const Table& table, dynamic_reconfigure::ConfigDescription& message) {
  for (std::size_t number = 0; number < table.group_count; ++number) {
    const Group& group = table.groups[number];
    dynamic_reconfigure::Group made;
    made.name = group.name;
    made.type = group.type;
    made.id = static_cast<int>(number);
    made.parent = group.parent;
    for (std::size_t i = 0; i < table.parameter_count; ++i) {
      const Parameter& row = table.parameters[i];
      if (row.group == static_cast<int>(number)) {
        dynamic_reconfigure::ParamDescription parameter;
        parameter.name = row.name;
        parameter.type = type_name(row.type);
        parameter.level = row.level;
        parameter.description = row.description;
        parameter.edit_method = row.edit_method;
        made.parameters.push_back(parameter);
      }
    }
    message.groups.push_back(made);
  }
}

Endpoints::Endpoints(ros::NodeHandle node, Change change) : change_(std::move(change)) {
  service_ = node.advertiseService("set_parameters", &Endpoints::set, this);
  descriptions_ =
      node.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = node.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, true);
}

void Endpoints::describe(const dynamic_reconfigure::ConfigDescription& description) {
  descriptions_.publish(description);
}

void Endpoints::update(const dynamic_reconfigure::Config& values) { updates_.publish(values); }

bool Endpoints::set(dynamic_reconfigure::ReconfigureRequest& request,
                    dynamic_reconfigure::ReconfigureResponse& response) {
  change_(request.config, response.config);
  return true;
}

}  // namespace reconfigure
}  // namespace gazelle
