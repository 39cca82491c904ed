// A small seeded generator whose numbers are the same on every compiler and library: PCG32 (O'Neill 2014, XSH RR
// 64/32). The standard's distributions are not portable, so the conversions are here too.
#pragma once

#include <cstdint>
#include <numbers>

namespace shadewright::builtin {

class Random {
 public:
  explicit Random(uint64_t seed, uint64_t stream = 1) : increment_((stream << 1) | 1) {
    next();
    state_ += seed;
    next();
  }

  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const uint32_t shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    const uint32_t rotation = static_cast<uint32_t>(old >> 59);
    return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
  }

  /// In [0, 1), a multiple of 2^-32.
  double unit() { return next() * 0x1p-32; }
  /// In [low, high).
  double range(double low, double high) { return low + (high - low) * unit(); }
  /// In 0 .. count - 1; `count` above 0.
  uint32_t index(uint32_t count) { return static_cast<uint32_t>((uint64_t{next()} * count) >> 32); }
  bool chance(double probability) { return unit() < probability; }
  /// In [0, 2 pi).
  double angle() { return range(0.0, 2.0 * std::numbers::pi); }

 private:
  uint64_t state_ = 0;
  uint64_t increment_;
};

}  // namespace shadewright::builtin
