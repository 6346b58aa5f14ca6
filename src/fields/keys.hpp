// What holds for the keys of every block: each is known, and given once.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace nbvopt {

/// Takes the keys of one block as a file gives them.
class KeyCheck {
 public:
  /// `noun` is what messages call them.
  explicit KeyCheck(std::vector<std::string> known, std::string noun = "key")
      : known_(std::move(known)), noun_(std::move(noun)) {}

  /// Throws InputError "<block>: unknown key '<key>', did you mean ...?" with the nearest right
  /// one, and "<name> is given twice, keep one".
  void take(const std::string& key, const std::string& block, const std::string& name);

 private:
  std::vector<std::string> known_;
  std::string noun_;
  std::vector<std::string> taken_;
};

/// Throws what KeyCheck throws of a key that is none of these.
[[noreturn]] void refuse_key(const std::string& key, const std::string& block,
                             std::span<const std::string> known, const std::string& noun = "key");

/// Throws InputError "<name> has no value, give one or leave the key out".
[[noreturn]] void refuse_missing_value(const std::string& name);

}  // namespace nbvopt
