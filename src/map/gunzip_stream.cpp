#include "map/gunzip_stream.hpp"

#include <new>
#include <string_view>
#include <utility>

#include "map/map_header.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

constexpr int kFirstByte = 0x1F;

/// How many times its packed size a map may have. Recorded .ot shrink to a fifteenth, .bt to a
/// half, and have four nodes a byte instead of one in five: a node takes some 50 bytes of memory.
std::uint64_t most_times(std::string_view first_bytes) {
  return first_bytes.starts_with(kFullMagic) ? 50 : 10;
}

}  // namespace

bool is_gzip(std::istream& in) { return in.peek() == kFirstByte; }

GunzipBuffer::GunzipBuffer(std::istream& packed, std::string name)
    : packed_(packed), name_(std::move(name)) {
  constexpr int kGzipOnly = 16;  // added to the window's bits: no other header is let through
  if (inflateInit2(&zlib_, MAX_WBITS + kGzipOnly) != Z_OK) throw std::bad_alloc();
}

GunzipBuffer::~GunzipBuffer() { inflateEnd(&zlib_); }

bool GunzipBuffer::refill() {
  if (zlib_.avail_in > 0) return true;
  packed_.read(in_.data(), static_cast<std::streamsize>(in_.size()));
  zlib_.next_in = reinterpret_cast<Bytef*>(in_.data());
  zlib_.avail_in = static_cast<uInt>(packed_.gcount());
  packed_bytes_ += zlib_.avail_in;
  return zlib_.avail_in > 0;
}

void GunzipBuffer::check_size() const {
  constexpr std::uint64_t kAlways = std::uint64_t{1} << 18;
  if (bytes_ <= kAlways + most_times_ * packed_bytes_) return;
  throw InputError(
      name_ + ": it unpacks to more than " + std::to_string(most_times_) +
      " times its size, as no recorded map does; if it is one, unpack it with gunzip " + "first");
}

GunzipBuffer::int_type GunzipBuffer::underflow() {
  for (;;) {
    if (!refill()) {
      if (is_between_members_) return traits_type::eof();
      throw InputError(name_ + ": the gzip data end too early, the file is truncated");
    }
    if (is_between_members_) {
      // As gunzip does: what follows the last member and is none is padding.
      if (*zlib_.next_in != kFirstByte) return traits_type::eof();
      inflateReset(&zlib_);
      is_between_members_ = false;
    }
    zlib_.next_out = reinterpret_cast<Bytef*>(out_.data());
    zlib_.avail_out = static_cast<uInt>(out_.size());
    const int status = inflate(&zlib_, Z_NO_FLUSH);
    if (status == Z_STREAM_END) {
      is_between_members_ = true;
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError(name_ + ": the gzip data are damaged");
    }
    const std::size_t unpacked = out_.size() - zlib_.avail_out;
    if (unpacked == 0) continue;
    if (most_times_ == 0) most_times_ = most_times({out_.data(), unpacked});
    bytes_ += unpacked;
    check_size();
    setg(out_.data(), out_.data(), out_.data() + unpacked);
    return traits_type::to_int_type(out_.front());
  }
}

}  // namespace nbvopt
