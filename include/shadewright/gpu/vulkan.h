// The one place that includes Vulkan-Hpp. Costs seconds a translation unit: our targets precompile it.
#pragma once

#include <vulkan/vulkan_raii.hpp>
