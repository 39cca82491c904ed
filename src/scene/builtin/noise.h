// Gradient noise (Perlin 1985, with the quintic fade of 2002) from hashed integer lattices, and its fractal sums.
#pragma once

#include <cstdint>

namespace shadewright::builtin {

/// About -1 .. 1, zero at integer points, smooth between; `seed` chooses the field.
double noise(double x, double y, uint32_t seed);
double noise(double x, double y, double z, uint32_t seed);

/// Sum of `octaves` noises, each at twice the frequency and `gain` times the height of the one before.
double fractal_noise(double x, double y, int octaves, double gain, uint32_t seed);

/// The same of 1 - |noise|, squared, each octave weighted by the one before: rough ridges, smooth valleys (Musgrave's
/// ridged multifractal), 0 .. 1 or so.
double ridged_noise(double x, double y, int octaves, double gain, uint32_t seed);

}  // namespace shadewright::builtin
