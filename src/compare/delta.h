// A picture as what it does not share with another: most of a technique's picture is the truth's.
#pragma once

#include "shadewright/image/picture.h"

namespace shadewright::compare {

/// `picture` without what it shares with `base`: transparent there. To be laid over `base`, which must be opaque and of
/// the same size, as `picture` must.
Picture delta(const Picture& picture, const Picture& base);

/// Whether `delta(picture, base)` is defined.
bool has_delta(const Picture& picture, const Picture& base);

}  // namespace shadewright::compare
