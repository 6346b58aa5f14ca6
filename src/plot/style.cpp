#include "plot/style.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nbvopt::style {

Colour gain_colour(double share) {
  constexpr std::array kViridis{rgb(0x440154), rgb(0x472D7B), rgb(0x3B528B),
                                rgb(0x2C728E), rgb(0x21918C), rgb(0x28AE80),
                                rgb(0x5EC962), rgb(0xADDC30), rgb(0xFDE725)};
  const double place = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1.0);
  const std::size_t before = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const Colour& low = kViridis[before];
  const Colour& high = kViridis[before + 1];
  const double way = place - static_cast<double>(before);
  return {std::lerp(low.red, high.red, way), std::lerp(low.green, high.green, way),
          std::lerp(low.blue, high.blue, way)};
}

}  // namespace nbvopt::style
