// The order in which packets of 16 rays cover a list of points: 4 x 4 tiles when the list is an image, runs of 16 when
// not. Packets are the same whatever the number of threads, and so are the results.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace shadewright {

inline constexpr uint32_t packet_size = 16;

/// The indices of one packet; lanes from `count` on are unused.
struct PacketIndices {
  size_t index[packet_size];
  uint32_t count = 0;
};

/// `size` points as rows of `row_length` (the last may be shorter), or as a plain list when it is 0.
class Tiling {
 public:
  Tiling(size_t size, uint32_t row_length)
      : size_(size),
        row_length_(row_length),
        tiles_across_((row_length + 3) / 4),
        packets_(row_length == 0 ? (size + packet_size - 1) / packet_size
                                 : tiles_across_ * (((size + row_length - 1) / row_length + 3) / 4)) {}

  size_t packet_count() const { return packets_; }

  PacketIndices packet(size_t number) const {
    PacketIndices result;
    if (row_length_ == 0) {
      const size_t end = std::min(size_, (number + 1) * packet_size);
      for (size_t i = number * packet_size; i < end; ++i) result.index[result.count++] = i;
      return result;
    }
    const size_t x0 = number % tiles_across_ * 4, y0 = number / tiles_across_ * 4;
    for (size_t y = y0; y < y0 + 4; ++y)
      for (size_t x = x0; x < std::min<size_t>(x0 + 4, row_length_); ++x)
        if (const size_t i = y * row_length_ + x; i < size_) result.index[result.count++] = i;
    return result;
  }

 private:
  size_t size_, row_length_, tiles_across_, packets_;
};

/// Calls body(PacketIndices) for every packet, on all cores.
template <typename Body>
void for_each_packet(const Tiling& tiling, Body&& body) {
  tbb::parallel_for(tbb::blocked_range<size_t>(0, tiling.packet_count(), 64), [&](const tbb::blocked_range<size_t>& r) {
    for (size_t i = r.begin(); i != r.end(); ++i) body(tiling.packet(i));
  });
}

}  // namespace shadewright
