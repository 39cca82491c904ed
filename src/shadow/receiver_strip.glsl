// The strip of the image that a pass over receivers works on (shadow/receiver_strips.h). Needs shadow/receivers.glsl before it.
layout(push_constant, scalar) SHADEWRIGHT_UNIFORM(ReceiverStrip, strip, load_strip)

// The image's pixel at `place` of the strip.
ivec2 strip_pixel(ivec2 place) { return place + ivec2(0, strip.first_row); }
// Where a buffer of one element a pixel of the strip keeps it.
uint strip_index(ivec2 pixel) { return (uint(pixel.y) - strip.first_row) * camera.size.x + uint(pixel.x); }
