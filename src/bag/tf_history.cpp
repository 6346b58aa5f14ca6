#include "bag/tf_history.hpp"

#include <algorithm>
#include <set>

namespace nbvopt {
namespace {

std::string without_slash(const std::string& name) {
  return name.starts_with('/') ? name.substr(1) : name;
}

Transform between(const Transform& a, const Transform& b, double share) {
  Transform T = Transform::Identity();
  T.translate((1.0 - share) * a.translation() + share * b.translation());
  T.rotate(Eigen::Quaterniond(a.rotation()).slerp(share, Eigen::Quaterniond(b.rotation())));
  return T;
}

}  // namespace

void TfHistory::add(const std::string& parent, const std::string& child, double time_s,
                    const Transform& T_parent_child, bool is_static) {
  Link& link = links_[without_slash(child)];
  link.is_static = is_static;
  if (is_static) link.samples.clear();
  link.samples.push_back({time_s, without_slash(parent), T_parent_child});
}

void TfHistory::finish() {
  for (auto& [child, link] : links_) {
    std::ranges::stable_sort(link.samples, {}, &Sample::time_s);
  }
}

std::string TfHistory::root_of(const std::string& frame) const {
  std::string root = without_slash(frame);
  std::set<std::string> seen;  // parents may go round in a circle
  for (auto link = links_.find(root); link != links_.end() && seen.insert(root).second;
       link = links_.find(root)) {
    root = link->second.samples.front().parent;
  }
  return root;
}

std::optional<TfHistory::Step> TfHistory::step_up(const std::string& child, double time_s,
                                                  double max_difference_s) const {
  const auto link = links_.find(child);
  if (link == links_.end()) return std::nullopt;
  const std::vector<Sample>& samples = link->second.samples;
  const auto step = [](const Sample& sample) { return Step{sample.parent, sample.T_parent_child}; };
  if (link->second.is_static) return step(samples.front());
  const auto after = std::ranges::lower_bound(samples, time_s, {}, &Sample::time_s);
  if (after == samples.begin() || after == samples.end()) {
    const Sample& nearest = after == samples.begin() ? samples.front() : samples.back();
    if (std::abs(nearest.time_s - time_s) > max_difference_s) return std::nullopt;
    return step(nearest);
  }
  const Sample& a = *(after - 1);
  const Sample& b = *after;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  if (a.parent != b.parent) return step(share < 0.5 ? a : b);
  return Step{a.parent, between(a.T_parent_child, b.T_parent_child, share)};
}

std::optional<Transform> TfHistory::look_up(const std::string& to, const std::string& from,
                                            double time_s, double max_difference_s) const {
  // All that carries `from`, with T_that_from; then up from `to` until both meet.
  std::map<std::string, Transform> carriers;
  std::string frame = without_slash(from);
  Transform T_frame_from = Transform::Identity();
  while (carriers.emplace(frame, T_frame_from).second) {
    const auto up = step_up(frame, time_s, max_difference_s);
    if (!up) break;
    frame = up->parent;
    T_frame_from = up->T_parent_child * T_frame_from;
  }
  frame = without_slash(to);
  Transform T_frame_to = Transform::Identity();
  std::set<std::string> seen;
  while (seen.insert(frame).second) {
    if (const auto met = carriers.find(frame); met != carriers.end()) {
      return T_frame_to.inverse() * met->second;
    }
    const auto up = step_up(frame, time_s, max_difference_s);
    if (!up) break;
    frame = up->parent;
    T_frame_to = up->T_parent_child * T_frame_to;
  }
  return std::nullopt;
}

std::vector<std::string> TfHistory::frames() const {
  std::set<std::string> names;
  for (const auto& [child, link] : links_) {
    names.insert(child);
    for (const Sample& sample : link.samples) names.insert(sample.parent);
  }
  return {names.begin(), names.end()};
}

}  // namespace nbvopt
