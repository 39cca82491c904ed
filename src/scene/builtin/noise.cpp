#include "scene/builtin/noise.h"

#include <algorithm>
#include <cmath>

namespace shadewright::builtin {
namespace {

uint32_t hash(int32_t x, int32_t y, int32_t z, uint32_t seed) {
  uint32_t h = seed * 0x9E3779B9u + static_cast<uint32_t>(x) * 0x85EBCA6Bu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du + static_cast<uint32_t>(y) * 0xC2B2AE35u;
  h = (h ^ (h >> 13)) * 0x297A2D39u + static_cast<uint32_t>(z) * 0x27D4EB2Fu;
  h = (h ^ (h >> 16)) * 0x45D9F3Bu;
  return h ^ (h >> 15);
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}
double mix(double a, double b, double t) {
  return a + (b - a) * t;
}

/// The hash picks one of eight gradients in the plane.
double slope(uint32_t h, double x, double y) {
  constexpr double diagonal = 0.70710678118654752;
  switch (h >> 29) {
    case 0:
      return x;
    case 1:
      return -x;
    case 2:
      return y;
    case 3:
      return -y;
    case 4:
      return diagonal * (x + y);
    case 5:
      return diagonal * (x - y);
    case 6:
      return diagonal * (y - x);
    default:
      return -diagonal * (x + y);
  }
}

/// One of the twelve edges of a cube, as Perlin has it.
double slope(uint32_t h, double x, double y, double z) {
  const uint32_t edge = h >> 28;
  const double u = edge < 8 ? x : y;
  const double v = edge < 4 ? y : (edge == 12 || edge == 14 ? x : z);
  return ((edge & 1) ? -u : u) + ((edge & 2) ? -v : v);
}

}  // namespace

double noise(double x, double y, uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const int32_t ix = static_cast<int32_t>(fx), iy = static_cast<int32_t>(fy);
  const double tx = x - fx, ty = y - fy, u = fade(tx), v = fade(ty);
  const auto corner = [&](int dx, int dy) { return slope(hash(ix + dx, iy + dy, 0, seed), tx - dx, ty - dy); };
  return 1.5 * mix(mix(corner(0, 0), corner(1, 0), u), mix(corner(0, 1), corner(1, 1), u), v);
}

double noise(double x, double y, double z, uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
  const int32_t ix = static_cast<int32_t>(fx), iy = static_cast<int32_t>(fy), iz = static_cast<int32_t>(fz);
  const double tx = x - fx, ty = y - fy, tz = z - fz, u = fade(tx), v = fade(ty), w = fade(tz);
  const auto corner = [&](int dx, int dy, int dz) {
    return slope(hash(ix + dx, iy + dy, iz + dz, seed), tx - dx, ty - dy, tz - dz);
  };
  const auto layer = [&](int dz) {
    return mix(mix(corner(0, 0, dz), corner(1, 0, dz), u), mix(corner(0, 1, dz), corner(1, 1, dz), u), v);
  };
  return mix(layer(0), layer(1), w);
}

double fractal_noise(double x, double y, int octaves, double gain, uint32_t seed) {
  double sum = 0, height = 1;
  for (int i = 0; i < octaves; ++i, x *= 2, y *= 2, height *= gain)
    sum += height * noise(x, y, seed + static_cast<uint32_t>(i));
  return sum;
}

double ridged_noise(double x, double y, int octaves, double gain, uint32_t seed) {
  double sum = 0, height = 0.5, weight = 1;
  for (int i = 0; i < octaves; ++i, x *= 2, y *= 2, height *= gain) {
    const double ridge = 1 - std::abs(noise(x, y, seed + static_cast<uint32_t>(i)));
    const double signal = ridge * ridge * weight;
    sum += height * signal;
    weight = std::min(1.0, 1.5 * signal);
  }
  return sum;
}

}  // namespace shadewright::builtin
