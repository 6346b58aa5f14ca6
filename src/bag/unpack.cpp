#include "bag/unpack.hpp"

#include <bzlib.h>
#include <lz4frame.h>

#include <algorithm>
#include <memory>

#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr std::uint64_t kStep = std::uint64_t{1} << 20;

[[noreturn]] void refuse_damaged() { throw InputError("its packed bytes are damaged"); }

/// Makes room for the next bytes, one more than there may be so that too many are noticed.
void grow(std::string& bytes, std::uint64_t used, std::uint64_t size) {
  if (used > size) refuse_damaged();
  bytes.resize(static_cast<std::size_t>(std::min(used + kStep, size + 1)));
}

}  // namespace

std::string unpack_bz2(std::string_view packed, std::uint64_t size) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream,
                                                                       BZ2_bzDecompressEnd);
  std::string bytes;
  std::uint64_t used = 0;
  stream.next_in = const_cast<char*>(packed.data());  // NOLINT: bzip2 does not write there
  stream.avail_in = static_cast<unsigned>(packed.size());
  for (int status = BZ_OK; status != BZ_STREAM_END;) {
    grow(bytes, used, size);
    stream.next_out = bytes.data() + used;
    stream.avail_out = static_cast<unsigned>(bytes.size() - used);
    status = BZ2_bzDecompress(&stream);
    const std::uint64_t made = bytes.size() - used - stream.avail_out;
    used += made;
    const bool is_stuck = made == 0 && stream.avail_in == 0 && status != BZ_STREAM_END;
    if ((status != BZ_OK && status != BZ_STREAM_END) || is_stuck) refuse_damaged();
  }
  if (used != size) refuse_damaged();
  bytes.resize(used);
  return bytes;
}

std::string unpack_lz4(std::string_view packed, std::uint64_t size) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) {
    throw std::bad_alloc();
  }
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> end(
      context, LZ4F_freeDecompressionContext);
  std::string bytes;
  std::uint64_t used = 0;
  for (std::size_t hint = 1; hint != 0;) {
    grow(bytes, used, size);
    std::size_t made = bytes.size() - used;
    std::size_t taken = packed.size();
    hint = LZ4F_decompress(context, bytes.data() + used, &made, packed.data(), &taken, nullptr);
    if (LZ4F_isError(hint) != 0 || (made == 0 && taken == 0 && hint != 0)) refuse_damaged();
    packed.remove_prefix(taken);
    used += made;
  }
  if (used != size) refuse_damaged();
  bytes.resize(used);
  return bytes;
}

}  // namespace nbvopt
