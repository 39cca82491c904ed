// Trees and bushes: trunk and branches of tubes, crowns of closed lumps or of single closed leaves.
#pragma once

#include "scene/builtin/random.h"
#include "scene/builtin/stage.h"

namespace shadewright::builtin {

/// How a crown is made.
enum class Crown {
  lumps,   ///< closed: a few bumpy balls, some 250 triangles a tree
  leaves,  ///< closed: thin kites of four triangles, `leaf_count` of them
  sheets   ///< not closed: bent quadrilaterals of two triangles, `leaf_count` of them
};

struct TreeShape {
  double height = 8;    ///< metres
  double spread = 2.6;  ///< radius of the crown
  Crown crown = Crown::lumps;
  uint32_t leaf_count = 400;
  double leaf_size = 0.22;  ///< length, metres
};

Prop broadleaf_tree(Scene& scene, const TreeShape& shape, Random& random);
/// A fir: tiers of cones (lumps) or drooping twigs of needles (leaves).
Prop conifer(Scene& scene, const TreeShape& shape, Random& random);
Prop bush(Scene& scene, double radius, const glm::vec3& albedo, Random& random);

/// A closed, thin kite from `base` along `direction`, `length` long, broadest across `side`: 4 triangles.
Mesh leaf(const glm::dvec3& base, const glm::dvec3& direction, const glm::dvec3& side, double length, double width);
/// Two triangles, bent along the middle: not closed.
Mesh leaf_sheet(const glm::dvec3& base, const glm::dvec3& direction, const glm::dvec3& side, double length,
                double width);
/// A ball with dents, for crowns and boulders: deterministic in `random`.
Mesh lump(const glm::dvec3& center, const glm::dvec3& radii, uint32_t segments, uint32_t rings, double roughness,
          Random& random);

}  // namespace shadewright::builtin
