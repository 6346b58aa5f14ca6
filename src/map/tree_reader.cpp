#include "map/tree_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

using Node = UncertaintyOcTreeNode;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

/// Which values an .ot file stores a node, in this order: log-odds always.
struct Payload {
  bool has_colour = false;
  bool has_uncertainty = false;
  bool has_others = false;  ///< which are skipped
};

/// Builds the tree from its node stream. OctoMap's own reader trusts the stream: it recurses as
/// deep as the bytes say and takes a truncated file for a whole one.
class TreeReader {
 public:
  TreeReader(ByteReader& in, const std::string& name, const MapHeader& header)
      : in_(in),
        name_(name),
        nodes_(header.nodes),
        tree_(std::make_unique<UncertaintyOcTree>(header.resolution_m)) {}

  std::unique_ptr<UncertaintyOcTree> read_binary() {
    if (has_root()) read_binary_children(tree_->make_root(), 0);
    return finished();
  }

  /// `other_bytes` are those of a node's values that are not known.
  template <Payload kPayload>
  std::unique_ptr<UncertaintyOcTree> read_full(std::size_t other_bytes = 0) {
    other_bytes_ = other_bytes;
    if (has_root()) read_full_node<kPayload>(tree_->make_root(), 0);
    return finished();
  }

  void warn_of_clamped_nodes(std::vector<std::string>& warnings) const {
    if (clamped_nodes_ == 0) return;
    warnings.push_back(std::to_string(clamped_nodes_) +
                       " nodes have an infinite log-odds, held to OctoMap's limits of -2 and 3.5");
  }

 private:
  bool has_root() { return nodes_ ? *nodes_ > 0 : !in_.at_end(); }

  const char* take(std::size_t count) {
    const char* bytes = in_.take(count);
    if (bytes != nullptr) return bytes;
    refuse(name_, "the file ends after " + std::to_string(tree_->size()) +
                      (nodes_ ? " of " + std::to_string(*nodes_) : "") + " nodes, it is truncated");
  }

  Node& make_child(Node& node, int index, int depth) {
    if (depth >= UncertaintyOcTree::kDepth) {
      refuse(name_, "the tree is deeper than 16 levels, the file is damaged");
    }
    if (nodes_ && tree_->size() >= *nodes_) {
      refuse(name_, "the tree has more than the " + std::to_string(*nodes_) +
                        " nodes that the header says, the file is damaged");
    }
    return *tree_->createNodeChild(&node, index);
  }

  /// Two bits a child: 0 unknown, 1 free leaf, 2 occupied leaf, 3 inner node. The codes of all
  /// children come first, then what is under the inner ones.
  void read_binary_children(Node& node, int depth) {
    const auto codes = number_at<std::uint16_t>(take(2));
    if (codes == 0) refuse(name_, "an inner node has no children, the file is damaged");
    const auto code = [codes](int i) { return codes >> 2 * i & 3; };
    for (int i = 0; i < 8; ++i) {
      if (code(i) == 0) continue;
      make_child(node, i, depth)
          .setLogOdds(code(i) == 1 ? tree_->getClampingThresMinLog()
                                   : tree_->getClampingThresMaxLog());
    }
    for (int i = 0; i < 8; ++i) {
      if (code(i) == 3) read_binary_children(*tree_->getNodeChild(&node, i), depth + 1);
    }
    node.updateOccupancyChildren();
  }

  /// The node's values, a mask of its children, then the children. Of an inner node, colour and u
  /// are kept as the file has them, so that a file stays the same when it is written again; its
  /// occupancy is restored, since searches rely on it.
  template <Payload kPayload>
  void read_full_node(Node& node, int depth) {
    constexpr std::size_t kColourAt = sizeof(float);
    constexpr std::size_t kUncertaintyAt = kColourAt + (kPayload.has_colour ? 3 : 0);
    constexpr std::size_t kOthersAt =
        kUncertaintyAt + (kPayload.has_uncertainty ? sizeof(float) : 0);
    const std::size_t mask_at = kOthersAt + (kPayload.has_others ? other_bytes_ : 0);

    const char* bytes = take(mask_at + 1);
    const float log_odds = clamped(number_at<float>(bytes));
    node.setLogOdds(log_odds);
    if constexpr (kPayload.has_colour) node.set_colour(number_at<Colour>(bytes + kColourAt));
    if constexpr (kPayload.has_uncertainty) {
      const auto uncertainty = number_at<float>(bytes + kUncertaintyAt);
      if (!(uncertainty >= 0.0F && uncertainty <= 1.0F)) {
        refuse(name_, "a node's uncertainty is " + std::to_string(uncertainty) + ", not in [0, 1]");
      }
      node.set_uncertainty(uncertainty);
    }
    const auto mask = number_at<std::uint8_t>(bytes + mask_at);
    for (int i = 0; i < 8; ++i) {
      if (mask >> i & 1) read_full_node<kPayload>(make_child(node, i, depth), depth + 1);
    }
    if (mask == 0) return;
    node.setLogOdds(node.getMaxChildLogOdds());
    if (kPayload.has_others && node.getLogOdds() != log_odds) refuse_values();
  }

  /// Certain, as programs write it that insert with a probability of 0 or 1, as far as OctoMap
  /// goes.
  float clamped(float log_odds) {
    if (std::isfinite(log_odds)) return log_odds;
    if (std::isnan(log_odds)) refuse(name_, "a node's log-odds is not a number");
    ++clamped_nodes_;
    return log_odds < 0.0F ? tree_->getClampingThresMinLog() : tree_->getClampingThresMaxLog();
  }

  /// Of a tree that is not known to begin its nodes with log-odds, and does not.
  [[noreturn]] void refuse_values() const;

  std::unique_ptr<UncertaintyOcTree> finished() {
    if (nodes_ && tree_->size() != *nodes_) {
      refuse(name_, "the tree has " + std::to_string(tree_->size()) +
                        " nodes, but the header says " + std::to_string(*nodes_));
    }
    return std::move(tree_);
  }

  ByteReader& in_;
  const std::string& name_;
  std::optional<std::uint64_t> nodes_;
  std::unique_ptr<UncertaintyOcTree> tree_;
  std::size_t other_bytes_ = 0;
  std::uint64_t clamped_nodes_ = 0;
};

[[noreturn]] void refuse_type(const std::string& name, const std::string& type) {
  refuse(name, "tree type '" + type +
                   "' is not known, or its nodes hold no occupancy: known are OcTree, "
                   "OcTreeStamped, ColorOcTree and UncertaintyOcTree; where the tree holds "
                   "occupancy, writeBinary() of the program that made it writes a .bt, which is "
                   "read whatever the type");
}

void TreeReader::refuse_values() const {
  refuse(name_, "an inner node's value is not the largest of its children's, as occupancy is");
}

std::string rest_of(ByteReader& in) {
  std::string rest;
  while (const char* byte = in.take(1)) rest += *byte;
  return rest;
}

/// A tree of another type: nodes of one size, which derived from OctoMap's begin with log-odds.
/// The size follows from the file's; that it is occupancy, from inner nodes.
std::unique_ptr<UncertaintyOcTree> read_unknown_type(ByteReader& in, const std::string& name,
                                                     const MapHeader& header,
                                                     std::vector<std::string>& warnings) {
  constexpr std::size_t kLeastBytes = sizeof(float) + 1;
  constexpr std::size_t kMostBytes = 256;
  if (!header.nodes || *header.nodes == 0) refuse_type(name, header.tree_type);
  std::string nodes = rest_of(in);
  const std::size_t node_bytes = nodes.size() / *header.nodes;
  if (nodes.size() % *header.nodes != 0 || node_bytes < kLeastBytes || node_bytes > kMostBytes) {
    refuse_type(name, header.tree_type);
  }
  std::istringstream stream(std::move(nodes));
  ByteReader bytes(stream);
  TreeReader reader(bytes, name, header);
  std::unique_ptr<UncertaintyOcTree> tree;
  try {
    tree = reader.read_full<Payload{.has_others = true}>(node_bytes - kLeastBytes);
  } catch (const InputError&) {
    refuse_type(name, header.tree_type);
  }
  warnings.push_back("tree type '" + header.tree_type +
                     "' is not known: its occupancy was read, the other " +
                     std::to_string(node_bytes - kLeastBytes) + " bytes a node were left out");
  return tree;
}

}  // namespace

std::unique_ptr<UncertaintyOcTree> read_tree(ByteReader& in, const std::string& name,
                                             const MapHeader& header,
                                             std::vector<std::string>& warnings) {
  const std::string& type = header.tree_type;
  TreeReader reader(in, name, header);
  std::unique_ptr<UncertaintyOcTree> tree;
  if (header.is_binary) {
    tree = reader.read_binary();
  } else if (type == "OcTree" || type == "OcTreeStamped") {  // stamps are not written
    tree = reader.read_full<Payload{}>();
  } else if (type == "ColorOcTree") {
    tree = reader.read_full<Payload{.has_colour = true}>();
  } else if (type == kUncertaintyType) {
    tree = reader.read_full<Payload{.has_colour = true, .has_uncertainty = true}>();
  } else if (type == "CountingOcTree") {
    refuse_type(name, type);
  } else {
    return read_unknown_type(in, name, header, warnings);
  }
  reader.warn_of_clamped_nodes(warnings);
  return tree;
}

}  // namespace nbvopt
