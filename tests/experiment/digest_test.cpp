#include "experiment/digest.hpp"

#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::experiment {
namespace {

TEST(Digest, IsThatOfTheReferenceImplementation) {
  // XXH128_hash_t of XXH3's published test vector for no bytes, seed 0.
  EXPECT_EQ(digest(""), "99aa06d3014798d86001c324468d497f");
}

TEST(Digest, OfAFileIsThatOfItsContent) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "some.txt";
  write_file_atomically(file, "some bytes");
  EXPECT_EQ(file_digest(file), digest("some bytes"));
  EXPECT_NE(digest("some bytes"), digest("some byte"));
}

}  // namespace
}  // namespace nbvopt::experiment
