// How the report has a method's pictures drawn, whatever draws them.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/render.h"

namespace penumbra::report {

/// A method that is ready to draw one scene.
class Drawer {
 public:
  virtual ~Drawer() = default;
  /// With the options that it was made for, but for size, samples per pixel and layers; visible
  /// fractions only if those had them.
  virtual RenderResult draw(const RenderOptions& options, Progress& progress) const = 0;
  /// Texels times samples of lights that were worked out before; none for methods without texels.
  virtual std::optional<std::uint64_t> texel_samples() const { return std::nullopt; }
};

/// Builds what a method needs of a scene: trees, fields, light on surfaces. Throws Error where the
/// method cannot show the scene.
using MakeDrawer = std::function<std::unique_ptr<Drawer>(const Scene&, const RenderOptions&)>;

}  // namespace penumbra::report
