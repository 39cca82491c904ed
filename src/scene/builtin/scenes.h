// Every built-in scene's entry in the registry; each is made in the file of its name.
#pragma once

#include "shadewright/scene/builtin.h"

namespace shadewright::builtin {

BuiltinScene chess();
BuiltinScene city();
BuiltinScene furball();
BuiltinScene landscape();
BuiltinScene sandbox();
BuiltinScene spheres();

}  // namespace shadewright::builtin
