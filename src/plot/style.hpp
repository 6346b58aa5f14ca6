// How the picture looks: one palette and one set of letters for all of its parts.
#pragma once

#include <vector>

#include "plot/canvas.hpp"

namespace nbvopt::style {

// Lines differ in lightness and dashes besides hue, and blue keeps clear of the map's red-to-green
// ramp: the views can be told apart without colour vision.
inline constexpr Colour kInk = rgb(0x1F2933);
inline constexpr Colour kMutedInk = rgb(0x5F6B76);
inline constexpr Colour kGridLine = rgb(0xE4E7EB);
inline constexpr Colour kPaper = rgb(0xFFFFFF);
inline constexpr Colour kUnknown = rgb(0xC9CED4);
inline constexpr Colour kFree = rgb(0xFBFBF9);
inline constexpr Colour kOccupied = rgb(0x3E4C59);  ///< of a map that carries no uncertainty
inline constexpr Colour kCurrent = kInk;
inline constexpr Colour kChosen = rgb(0x0B5FA5);
inline constexpr Colour kUnknownGain = rgb(0xB8C2CC);
inline constexpr Colour kOccupiedGain = rgb(0xE69F00);
inline constexpr Colour kPath = rgb(0xFF7A45);  ///< of the search, over the colours of gains

/// The colour of a share of the greatest gain, in [0, 1]: viridis, whose lightness grows evenly.
Colour gain_colour(double share);

inline Stroke current_stroke() { return {kCurrent, 1.5, {5.0, 3.5}}; }
inline Stroke chosen_stroke() { return {kChosen, 2.0}; }

inline TextStyle title() { return {.size = 20.0, .colour = kInk, .bold = true}; }
inline TextStyle heading() { return {.size = 12.5, .colour = kInk, .bold = true}; }
inline TextStyle body(Anchor anchor = Anchor::left) {
  return {.size = 12.0, .colour = kInk, .anchor = anchor};
}
inline TextStyle note(Anchor anchor = Anchor::left) {
  return {.size = 11.0, .colour = kMutedInk, .anchor = anchor};
}

}  // namespace nbvopt::style
