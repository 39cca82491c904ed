// perspective: one projective matrix a layer, like uniform's; only how it is chosen differs, and that is the host's work.
#include "shadow/parameterization/uniform/uniform.glsl"
