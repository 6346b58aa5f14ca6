#include "cli/options/depth_image_arguments.hpp"

#include <CLI/Option.hpp>
#include <CLI/Validators.hpp>

#include "cli/options/arguments.hpp"
#include "core/number.hpp"
#include "map/scan_names.hpp"

namespace nbvopt {

void add_depth_image_arguments(CLI::App& app, DepthImageArguments& arguments,
                               const std::string& fallback) {
  const DepthImageOptions defaults;
  const auto or_default = [&fallback](const std::string& value) {
    return " [" + (fallback.empty() ? value : fallback) + "]";
  };
  app.add_option_function<std::string>(
         "--intrinsics",
         [&arguments](const std::string& text) {
           const auto n = numbers_argument("--intrinsics", text, {4}, "FX,FY,CX,CY");
           arguments.fx_fy_cx_cy_px = {n[0], n[1], n[2], n[3]};
         },
         "of a depth image, in pixels; FY is negative where rows run upwards" +
             (fallback.empty() ? "" : or_default("")))
      ->type_name("FX,FY,CX,CY");
  add_number(app, "--depth-scale", arguments.depth_scale_m, "M",
             "metres a unit of a depth image" + or_default(format_number(defaults.depth_scale_m)));
  app.add_option("--largest-value", arguments.largest_value,
                 "what 65535 means in a depth image: no_return (nothing in range, the ray is "
                 "clear), invalid (not known, as 0) or far (that depth)" +
                     or_default(to_string(defaults.largest_value)))
      ->check(CLI::IsMember(enum_names<LargestValue>()))
      ->type_name("NAME");
}

std::optional<DepthImageOptions> depth_image_options(const DepthImageArguments& arguments) {
  if (!arguments.fx_fy_cx_cy_px) return std::nullopt;
  const auto [fx, fy, cx, cy] = *arguments.fx_fy_cx_cy_px;
  DepthImageOptions options{.fx_px = fx, .fy_px = fy, .cx_px = cx, .cy_px = cy};
  options.depth_scale_m = arguments.depth_scale_m.value_or(options.depth_scale_m);
  options.largest_value =
      enum_value<LargestValue>(arguments.largest_value).value_or(options.largest_value);
  return options;
}

}  // namespace nbvopt
