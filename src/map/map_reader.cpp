#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "core/input_file.hpp"
#include "core/number.hpp"
#include "map/byte_reader.hpp"
#include "map/map_header.hpp"
#include "map/uncertainty_octree.hpp"
#include "map/whole_number.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"

namespace nbvopt {

namespace {

using Node = UncertaintyOcTreeNode;

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

struct Header {
  bool is_binary = false;  ///< .bt
  std::string tree_type;
  std::uint64_t nodes = 0;
  double resolution_m = 0.0;
};

/// Reads up to the line "data", which the nodes follow.
Header read_header(ByteReader& in, const std::string& name) {
  constexpr std::size_t kMaxLine = 1024;
  constexpr int kMaxLines = 1000;
  constexpr const char* kNotAMap = "this is not an OctoMap file (.bt or .ot)";

  const auto first = in.take_line(kMaxLine);
  if (!first) refuse(name, kNotAMap);
  Header header;
  header.is_binary = first->starts_with(kBinaryMagic);
  if (!header.is_binary && !first->starts_with(kFullMagic)) refuse(name, kNotAMap);

  std::optional<std::uint64_t> nodes;
  for (int i = 0; i < kMaxLines; ++i) {
    const auto line = in.take_line(kMaxLine);
    if (!line) refuse(name, "the header has no line 'data', the file is truncated or damaged");
    std::istringstream words(*line);
    std::string key;
    std::string value;
    words >> key >> value;
    if (key == "data") {
      if (header.tree_type.empty()) refuse(name, "the header has no 'id'");
      if (!nodes) refuse(name, "the header's 'size' must be there, a number of nodes");
      if (!(header.resolution_m > 0.0) || !std::isfinite(header.resolution_m)) {
        refuse(name, "the header's 'res' must be there, positive and finite");
      }
      header.nodes = *nodes;
      return header;
    }
    if (key == "id") header.tree_type = value;
    if (key == "size") nodes = parse_whole_number(value);
    if (key == "res") header.resolution_m = parse_number(value).value_or(0.0);
  }
  refuse(name, "the header has too many lines, the file is damaged");
}

/// Which values an .ot file stores a node, in this order: log-odds always.
struct Payload {
  bool has_colour = false;
  bool has_uncertainty = false;
};

/// Builds the tree from its node stream. OctoMap's own reader trusts the stream: it recurses as
/// deep as the bytes say and takes a truncated file for a whole one.
class TreeReader {
 public:
  TreeReader(ByteReader& in, const std::string& name, const Header& header)
      : in_(in),
        name_(name),
        max_nodes_(header.nodes),
        tree_(std::make_unique<UncertaintyOcTree>(header.resolution_m)) {}

  std::unique_ptr<UncertaintyOcTree> read_binary() {
    if (max_nodes_ > 0) read_binary_children(tree_->make_root(), 0);
    return finished();
  }

  template <Payload kPayload>
  std::unique_ptr<UncertaintyOcTree> read_full() {
    if (max_nodes_ > 0) read_full_node<kPayload>(tree_->make_root(), 0);
    return finished();
  }

 private:
  const char* take(std::size_t count) {
    const char* bytes = in_.take(count);
    if (bytes == nullptr) {
      refuse(name_, "the file ends after " + std::to_string(tree_->size()) + " of " +
                        std::to_string(max_nodes_) + " nodes, it is truncated");
    }
    return bytes;
  }

  Node& make_child(Node& node, int index, int depth) {
    if (depth >= UncertaintyOcTree::kDepth) {
      refuse(name_, "the tree is deeper than 16 levels, the file is damaged");
    }
    if (tree_->size() >= max_nodes_) {
      refuse(name_, "the tree has more than the " + std::to_string(max_nodes_) +
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
    constexpr std::size_t kMaskAt = kUncertaintyAt + (kPayload.has_uncertainty ? sizeof(float) : 0);

    const char* bytes = take(kMaskAt + 1);
    const auto log_odds = number_at<float>(bytes);
    if (!std::isfinite(log_odds)) refuse(name_, "a node's log-odds is not finite");
    node.setLogOdds(log_odds);
    if constexpr (kPayload.has_colour) node.set_colour(number_at<Colour>(bytes + kColourAt));
    if constexpr (kPayload.has_uncertainty) {
      const auto uncertainty = number_at<float>(bytes + kUncertaintyAt);
      if (!(uncertainty >= 0.0F && uncertainty <= 1.0F)) {
        refuse(name_, "a node's uncertainty is " + std::to_string(uncertainty) + ", not in [0, 1]");
      }
      node.set_uncertainty(uncertainty);
    }
    const auto mask = number_at<std::uint8_t>(bytes + kMaskAt);
    for (int i = 0; i < 8; ++i) {
      if (mask >> i & 1) read_full_node<kPayload>(make_child(node, i, depth), depth + 1);
    }
    if (mask != 0) node.setLogOdds(node.getMaxChildLogOdds());
  }

  std::unique_ptr<UncertaintyOcTree> finished() {
    if (tree_->size() != max_nodes_) {
      refuse(name_, "the tree has " + std::to_string(tree_->size()) +
                        " nodes, but the header says " + std::to_string(max_nodes_));
    }
    return std::move(tree_);
  }

  ByteReader& in_;
  const std::string& name_;
  std::uint64_t max_nodes_;
  std::unique_ptr<UncertaintyOcTree> tree_;
};

constexpr const char* kUncertaintyType = "UncertaintyOcTree";

std::unique_ptr<UncertaintyOcTree> read_tree(ByteReader& in, const std::string& name,
                                             const Header& header) {
  TreeReader reader(in, name, header);
  if (header.is_binary) return reader.read_binary();
  if (header.tree_type == "OcTree") return reader.read_full<Payload{false, false}>();
  if (header.tree_type == "ColorOcTree") return reader.read_full<Payload{true, false}>();
  if (header.tree_type == kUncertaintyType) return reader.read_full<Payload{true, true}>();
  refuse(name, "unknown tree type '" + header.tree_type +
                   "', known are OcTree, ColorOcTree and UncertaintyOcTree");
}

}  // namespace

UncertaintyMap read_map(std::istream& in, const std::string& name) {
  ByteReader reader(in);
  const Header header = read_header(reader, name);
  const bool is_plain = header.is_binary || header.tree_type != kUncertaintyType;
  return UncertaintyMap(read_tree(reader, name, header), is_plain);
}

UncertaintyMap read_map(const std::filesystem::path& path) {
  std::ifstream in = open_input_file(path);
  return read_map(in, path.string());
}

}  // namespace nbvopt
