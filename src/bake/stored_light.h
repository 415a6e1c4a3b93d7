// What a file of bake_store() knows of its lights' visibility, for pictures.
#pragma once

#include <memory>

#include "render/known_light.h"

namespace penumbra::bake {

/// Immutable; thread-safe. Visible fractions are read bilinearly; of samples each one's bit is, so
/// that a surface, matte or glossy, is lit by the light points that it sees as the ray tracer's
/// `area` would be with the same points. Surfaces that hold nothing know nothing.
class StoredLight final : public KnownLight {
 public:
  /// `scene`: read from `file`, with its lights and maybe some of other emission; Scene's
  /// stores_visibility is true. Keeps a reference to it. Throws InputError for a file that
  /// contradicts itself or is damaged, and for lights that were not there when it was baked.
  StoredLight(const std::string& file, const Scene& scene);
  ~StoredLight() override;

  /// "visible fractions" or "samples", for people.
  const char* what() const;

  void irradiances(std::size_t light, std::span<const TilePoint> points,
                   std::span<float> out) const override;
  void visible_fractions(std::size_t light, std::span<const TilePoint> points,
                         std::span<float> out) const override;
  bool arrivals(std::size_t light, std::span<const TilePoint> points,
                std::span<const std::uint8_t> asked, std::span<LightArrival> out) const override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace penumbra::bake
