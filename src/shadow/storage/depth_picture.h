// A picture of a map's depths, for people.
#pragma once

#include "shadewright/gpu/resources.h"
#include "shadewright/image/picture.h"

namespace shadewright::shadow {

/// Near bright and empty (1) black, layers one below the other. Waits; leaves the map in shader-read layout.
Picture depth_picture(const gpu::Device& device, gpu::Image& map);

}  // namespace shadewright::shadow
