// Reading what gzip packed.
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <istream>
#include <memory>
#include <streambuf>
#include <string>

namespace nbvopt {

/// Unpacks gzip members, one after the other, as they are read. Throws InputError that names the
/// file: damaged or truncated data, and data that unpack to far more than maps do.
class GunzipBuffer : public std::streambuf {
 public:
  /// `packed` must outlive the buffer.
  GunzipBuffer(std::istream& packed, std::string name);
  ~GunzipBuffer() override;
  GunzipBuffer(const GunzipBuffer&) = delete;
  GunzipBuffer& operator=(const GunzipBuffer&) = delete;

 protected:
  int_type underflow() override;

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 16;

  /// Whether there are packed bytes left.
  bool refill();
  void check_size() const;

  std::istream& packed_;
  std::string name_;
  z_stream zlib_{};
  bool is_between_members_ = false;
  std::uint64_t most_times_ = 0;  ///< the packed size; 0 before it is known what is packed
  std::uint64_t packed_bytes_ = 0;
  std::uint64_t bytes_ = 0;
  std::array<char, kBlockBytes> in_;
  std::array<char, kBlockBytes> out_;
};

/// Whether gzip packed what the stream holds.
bool is_gzip(std::istream& in);

/// A stream over such a buffer, which lets its errors through.
class GunzipStream : public std::istream {
 public:
  GunzipStream(std::istream& packed, std::string name)
      : std::istream(nullptr), buffer_(std::make_unique<GunzipBuffer>(packed, std::move(name))) {
    rdbuf(buffer_.get());
    exceptions(std::ios::badbit);
  }

 private:
  std::unique_ptr<GunzipBuffer> buffer_;
};

}  // namespace nbvopt
