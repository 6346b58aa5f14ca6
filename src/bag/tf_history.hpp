// Where frames were when, as a recording of tf tells.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nbvopt/core/transform.hpp"

namespace nbvopt {

class TfHistory {
 public:
  /// A child is where it was told last to be for all times where it is static. Leading slashes of
  /// names are left out.
  void add(const std::string& parent, const std::string& child, double time_s,
           const Transform& T_parent_child, bool is_static);

  /// To be called once all is added, before what follows.
  void finish();

  /// The frame that nothing is told to carry, on the way up from this one.
  std::string root_of(const std::string& frame) const;

  /// T_to_from at a time: between two that were told linear and on the shortest turn, up to
  /// `max_difference_s` beyond the first and last as these. None where a frame was not told of
  /// then, or nothing connects the two.
  std::optional<Transform> look_up(const std::string& to, const std::string& from, double time_s,
                                   double max_difference_s) const;

  bool empty() const { return links_.empty(); }
  /// All frames, for messages.
  std::vector<std::string> frames() const;

 private:
  struct Sample {
    double time_s;
    std::string parent;
    Transform T_parent_child;
  };
  struct Link {
    std::vector<Sample> samples;  ///< by time
    bool is_static = false;
  };
  struct Step {
    std::string parent;
    Transform T_parent_child;
  };
  std::optional<Step> step_up(const std::string& child, double time_s,
                              double max_difference_s) const;

  std::map<std::string, Link> links_;  ///< by the child
};

}  // namespace nbvopt
