// requests=sort (RMSM, algorithm 2, step 4): of neighbouring pixels that ask for the same page one request stays: what the pixel to
// the left or below asks for too goes.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
layout(binding = 0, scalar) readonly buffer Requests { uint requests[]; };
layout(binding = 1, scalar) writeonly buffer Kept { uint kept[]; };
layout(push_constant, scalar) uniform Push {
  uvec2 size;
  uint levels;
  uint row_of_groups;
};

void main() {
  uint index = gl_GlobalInvocationID.y * row_of_groups * 64u + gl_GlobalInvocationID.x;
  if (index >= requests.length()) return;
  uint request = requests[index], pixels = size.x * size.y, pixel = index % pixels;
  bool repeats = false;
  if (index < levels * pixels) {
    repeats = pixel % size.x > 0 && requests[index - 1] == request;
    repeats = repeats || (pixel / size.x + 1 < size.y && requests[index + size.x] == request);
  }
  kept[index] = repeats ? ~0u : request;
}
