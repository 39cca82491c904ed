// A named amount of memory, as techniques tell it and the report lists it.
#pragma once

#include <cstdint>
#include <string>

namespace shadewright {

struct Allocation {
  std::string name;
  uint64_t bytes = 0;
};

}  // namespace shadewright
