// Node animations.
#pragma once

#include <vector>

#include "scene/gltf/document.h"
#include "scene/gltf/poses.h"

namespace penumbra::gltf {

struct Motion {
  Poses poses;
  std::vector<double> times;  ///< first and last keyframe, seconds; empty without animation
};

/// The nodes as the document's first animation has them at `time`, seconds (glTF 2.0, section 3.11
/// and appendix C): before its first keyframe and after its last they stand still. Warns of what is
/// left out: further animations, weights of morph targets, nodes with a matrix. InputError for
/// samplers whose data do not fit.
Motion motion_at(Document& document, double time);

}  // namespace penumbra::gltf
