// Every built-in scene's entry in the registry; each is made in the file of its name.
#pragma once

#include "shadewright/scene/builtin.h"

namespace shadewright::builtin {

BuiltinScene characters();
BuiltinScene chess();
BuiltinScene city();
BuiltinScene ecosystem();
BuiltinScene furball();
BuiltinScene landscape();
BuiltinScene lattice();
BuiltinScene playground();
BuiltinScene ruins();
BuiltinScene sandbox();
BuiltinScene spheres();
BuiltinScene street();
BuiltinScene town();
BuiltinScene trees();

}  // namespace shadewright::builtin
