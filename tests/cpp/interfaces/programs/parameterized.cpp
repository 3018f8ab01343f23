// A node whose parameters generate_parameter_library declares; tells what they are and what it
// refuses.
#include <arm_parameters.hpp>
#include <cstdio>
#include <rclcpp/rclcpp.hpp>

namespace {

void tried(rclcpp::Node& node, const rclcpp::Parameter& parameter) {
  const auto result = node.set_parameter(parameter);
  std::printf("%s: %s\n", parameter.get_name().c_str(),
              result.successful ? "set" : result.reason.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("arm");
  try {
    arm_controller::ParamListener listener(node);
    auto params = listener.get_params();
    std::printf("rate %.1f needed %d label %s weights %zu\n", params.rate,
                static_cast<int>(params.needed), std::string{params.label}.c_str(),
                params.weights.size());
    std::printf("elbow %.1f\n", params.gains.joints_map.at("elbow").p);
    listener.setUserCallback([](const auto& changed) { std::printf("now %.1f\n", changed.rate); });
    tried(*node, rclcpp::Parameter("rate", 100.0));
    std::printf("old %d\n", listener.is_old(params));
    tried(*node, rclcpp::Parameter("mode", "sideways"));
    tried(*node, rclcpp::Parameter("needed", 4));
    listener.clearUserCallback();
    tried(*node, rclcpp::Parameter("joints", std::vector<std::string>{"wrist"}));
    listener.refresh_dynamic_parameters();
    params = listener.get_params();
    std::printf("joints %zu wrist %.1f declared %d\n", params.gains.joints_map.size(),
                params.gains.joints_map.at("wrist").p, node->has_parameter("gains.wrist.p"));
    const auto range = node->describe_parameter("rate").floating_point_range.at(0);
    std::printf("above zero %d up to %.0f\n", range.from_value > 0.0, range.to_value);
  } catch (const std::exception& error) {
    std::printf("refused: %s\n", error.what());
  }
  rclcpp::shutdown();
  return 0;
}
