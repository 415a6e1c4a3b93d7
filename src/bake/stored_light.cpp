#include "bake/stored_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "bake/light_key.h"
#include "bake/sample_file.h"
#include "bake/stored_surface.h"
#include "base/error.h"
#include "image/texture.h"
#include "scene/gltf/json_document.h"

namespace penumbra::bake {
namespace {

constexpr const char* root_path = "asset.extras.penumbra.store";
constexpr const char* remedy = "bake the scene again";
constexpr int most_side = 16384;

struct PageSize {
  int width, height;
};

/// Reads what bake_store() describes; everything may be anything.
class StoreReader {
 public:
  explicit StoreReader(const std::string& file)
      : document_(file), store_(document_.root()["asset"]["extras"]["penumbra"]["store"]) {}

  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw document_.error(path.empty() ? root_path : root_path + ("." + path), what, remedy);
  }

  bool is_of_samples() const {
    const Json::Value& kind = store_["kind"];
    if (kind == "samples") return true;
    if (kind != "visibility")
      fail("kind", "what is stored is neither \"visibility\" nor \"samples\"");
    return false;
  }

  std::vector<PageSize> pages() const {
    std::vector<PageSize> sizes;
    const Json::Value& pages = store_["pages"];
    if (!pages.isArray()) fail("pages", "the sizes of pages are missing");
    for (const Json::Value& page : pages) {
      const bool is_pair = page.isArray() && page.size() == 2 && page[0].isInt() && page[1].isInt();
      if (!is_pair || page[0].asInt() < 1 || page[1].asInt() < 1 || page[0].asInt() > most_side ||
          page[1].asInt() > most_side)
        fail(fmt::format("pages[{}]", sizes.size()), "this is no size of a page");
      sizes.push_back({page[0].asInt(), page[1].asInt()});
    }
    return sizes;
  }

  /// By material of the file.
  std::vector<int> pages_of_materials(std::size_t pages) const {
    std::vector<int> out;
    for (const Json::Value& material : document_.root()["materials"]) {
      const Json::Value& extras = material["extras"];
      const Json::Value& own =
          extras.isObject() ? extras["penumbra"] : Json::Value::nullSingleton();
      const Json::Value& page = own.isObject() ? own["page"] : Json::Value::nullSingleton();
      const bool is_one =
          page.isInt() && page.asInt() >= 0 && static_cast<std::size_t>(page.asInt()) < pages;
      out.push_back(is_one ? page.asInt() : -1);
    }
    return out;
  }

  /// By light of the scene, its number in the file.
  std::vector<std::size_t> lights_of(const Scene& scene) const {
    const Json::Value& stored = lights();
    const Bounds box = bounds_of(scene);
    const float extent = length(box.hi - box.lo);
    std::vector<bool> taken(stored.size());
    std::vector<std::size_t> found;
    for (const Light& light : scene.lights) {
      std::size_t i = 0;
      while (i < stored.size() &&
             (taken[i] || !is_light(stored[static_cast<Json::ArrayIndex>(i)], light, extent)))
        ++i;
      if (i == stored.size())
        throw InputError(
            {document_.file()},
            fmt::format("what is seen of the {} light \"{}\" is not stored in the file: it was "
                        "added, or has another place or size",
                        to_string(light.type), light.name),
            "bake the scene again, or choose another method by --shadows");
      taken[i] = true;
      found.push_back(i);
    }
    return found;
  }
  std::size_t light_count() const { return lights().size(); }

  /// The visible fractions of light `l` on page `p`, 8-bit codes.
  std::vector<std::uint8_t> fractions(std::size_t l, std::size_t p, const PageSize& size) const {
    const Json::Value& textures = lights()[static_cast<Json::ArrayIndex>(l)]["textures"];
    const std::string path = fmt::format("lights[{}].textures[{}]", l, p);
    const Json::Value& root = document_.root();
    const auto element = [&](const char* array, const Json::Value& index) -> const Json::Value& {
      if (!index.isUInt() || !root[array].isArray() || index.asUInt() >= root[array].size() ||
          !root[array][index.asUInt()].isObject())
        fail(path, fmt::format("its {} are not in the file", array));
      return root[array][index.asUInt()];
    };
    if (!textures.isArray() || p >= textures.size()) fail(path, "a texture is missing");
    const Json::Value& texture = element("textures", textures[static_cast<Json::ArrayIndex>(p)]);
    const std::string_view png = view(element("images", texture["source"])["bufferView"], path);
    TextureImage image;
    if (!decode_texture(reinterpret_cast<const std::uint8_t*>(png.data()), png.size(), image))
      fail(path, "the texture is damaged");
    if (image.width != size.width || image.height != size.height)
      fail(path, "the texture is not of its page's size");
    std::vector<std::uint8_t> codes(image.rgba.size() / 4);
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = image.rgba[4 * i];
    return codes;
  }

  SampleFile samples(std::size_t pages) const {
    const Json::Value& of_samples = store_["samples"];
    if (!of_samples.isObject()) fail("samples", "they are missing");
    try {
      return parse_samples(view(of_samples["bufferView"], "samples.bufferView"), light_count(),
                           pages);
    } catch (const std::runtime_error& error) {
      fail("samples", fmt::format("the stored samples are damaged: {}", error.what()));
    }
  }

 private:
  const Json::Value& lights() const {
    const Json::Value& lights = store_["lights"];
    if (!lights.isArray() ||
        std::ranges::any_of(lights, [](const Json::Value& light) { return !light.isObject(); }))
      fail("lights", "the list of lights is missing");
    return lights;
  }

  std::string_view view(const Json::Value& index, const std::string& path) const {
    const Json::Value& views = document_.root()["bufferViews"];
    if (!index.isUInt() || !views.isArray() || index.asUInt() >= views.size() ||
        !views[index.asUInt()].isObject())
      fail(path, "its bufferView is not in the file");
    const Json::Value &own = views[index.asUInt()], &from = own["byteOffset"],
                      &length = own["byteLength"];
    const std::string_view bin = document_.source().bin();
    const std::uint64_t begin = from.isUInt64() ? from.asUInt64() : 0;
    if (own["buffer"] != 0 || !length.isUInt64() || begin > bin.size() ||
        length.asUInt64() > bin.size() - begin)
      fail(path, "its bufferView is not within the file");
    return bin.substr(begin, length.asUInt64());
  }

  gltf::JsonDocument document_;
  const Json::Value& store_;
};

/// The four texels round a place, and their weights. `at`: in texels, ½ is the middle of the first.
struct Corners {
  std::size_t texels[4];
  float weights[4];

  Corners(const Vec2& at, int width, int height) {
    const float x = std::clamp(at.x - 0.5f, 0.0f, static_cast<float>(width - 1));
    const float y = std::clamp(at.y - 0.5f, 0.0f, static_cast<float>(height - 1));
    const int x0 = std::min(static_cast<int>(x), width - 1);
    const int y0 = std::min(static_cast<int>(y), height - 1);
    const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
    for (int k = 0; k < 4; ++k) {
      const int i = std::min(x0 + k % 2, width - 1), j = std::min(y0 + k / 2, height - 1);
      texels[k] = static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(i);
      weights[k] = (k % 2 ? u : 1 - u) * (k / 2 ? v : 1 - v);
    }
  }
};

/// In the chart's texels.
Vec2 in_chart(const SampledChart& chart, const Vec2& page) {
  const auto x = static_cast<float>(chart.place.x), y = static_cast<float>(chart.place.y);
  return chart.place.turned ? Vec2{x + 1 - page.x, y + 1 - page.y} : Vec2{page.x - x, page.y - y};
}

/// How far a place is beyond a chart's border or, of two triangles that share a block, beyond the
/// diagonal; of the charts that may hold it the one with the least does.
float beyond(const SampledChart& chart, const Vec2& page) {
  const Vec2 at = in_chart(chart, page);
  const float s = at.x / static_cast<float>(chart.width),
              t = at.y / static_cast<float>(chart.height);
  if (s < 0 || t < 0 || s > 1 || t > 1) return INFINITY;
  return s + t;
}

constexpr int cell = 64;  // texels

/// Which chart each triangle is in.
class ChartFinder {
 public:
  explicit ChartFinder(const std::vector<SampledChart>& charts) : charts_(charts) {
    for (std::uint32_t c = 0; c < charts.size(); ++c) {
      const ChartPlace& p = charts[c].place;
      const int x0 = p.turned ? p.x - charts[c].width + 1 : p.x,
                y0 = p.turned ? p.y - charts[c].height + 1 : p.y;
      for (int y = y0 / cell; y <= (y0 + charts[c].height) / cell; ++y)
        for (int x = x0 / cell; x <= (x0 + charts[c].width) / cell; ++x)
          cells_[key(p.page, x, y)].push_back(c);
    }
  }

  std::uint32_t find(int page, const Vec2& at) const {
    std::uint32_t best = none;
    float least = INFINITY;
    const auto it =
        cells_.find(key(page, static_cast<int>(at.x) / cell, static_cast<int>(at.y) / cell));
    if (it == cells_.end()) return none;
    for (const std::uint32_t c : it->second)
      if (const float d = beyond(charts_[c], at); d < least) least = d, best = c;
    return best;
  }

  static constexpr std::uint32_t none = 0xffffffffu;

 private:
  static std::uint64_t key(int page, int x, int y) {
    return static_cast<std::uint64_t>(page) << 40 | static_cast<std::uint64_t>(y + 1) << 20 |
           static_cast<std::uint64_t>(x + 1);
  }

  const std::vector<SampledChart>& charts_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

bool bit_of(const std::uint8_t* bits, std::size_t at) { return bits[at / 8] >> (at % 8) & 1; }

}  // namespace

struct StoredLight::Parts {
  Parts(const std::string& file, const Scene& scene)
      : reader(file),
        of_samples(reader.is_of_samples()),
        pages(reader.pages()),
        surface(scene, reader.pages_of_materials(pages.size())),
        numbers(reader.lights_of(scene)) {
    if (of_samples)
      read_samples(scene);
    else
      for (std::size_t l = 0; l < reader.light_count(); ++l) {
        auto& own = fractions.emplace_back();
        for (std::size_t p = 0; p < pages.size(); ++p)
          own.push_back(reader.fractions(l, p, pages[p]));
      }
  }

  void read_samples(const Scene& scene) {
    samples = reader.samples(pages.size());
    const ChartFinder finder(samples.charts);
    chart_of.resize(scene.instances.size());
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      if (surface.page(i) < 0) continue;
      const std::size_t count = scene.meshes[scene.instances[i].mesh].triangle_count();
      for (std::uint32_t t = 0; t < count; ++t)
        chart_of[i].push_back(
            finder.find(surface.page(i), in_page(surface.page(i), surface.middle({i, t}))));
    }
  }

  Vec2 in_page(int page, const Vec2& uv) const {
    const PageSize& size = pages[static_cast<std::size_t>(page)];
    return {uv.x * static_cast<float>(size.width), uv.y * static_cast<float>(size.height)};
  }

  float fraction(std::size_t light, const PagePoint& at) const {
    const auto& codes = fractions[numbers[light]][static_cast<std::size_t>(at.page)];
    const PageSize& size = pages[static_cast<std::size_t>(at.page)];
    const Corners corners(in_page(at.page, at.uv), size.width, size.height);
    float sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += corners.weights[k] * static_cast<float>(codes[corners.texels[k]]);
    return sum / 255;
  }

  LightArrival sampled(std::size_t light, const TilePoint& point, const PagePoint& at) const {
    const std::uint32_t number = chart_of[at.triangle.instance][at.triangle.triangle];
    if (number == ChartFinder::none) return {};
    const SampledChart& chart = samples.charts[number];
    const std::size_t l = numbers[light];
    const SampledLight& points = samples.lists[chart.lists[l]];
    const std::size_t n = points.samples.size();
    if (n == 0) return {0, 0, {0, 0}};
    const Corners corners(in_chart(chart, in_page(at.page, at.uv)), chart.width, chart.height);
    thread_local std::vector<LightPoint> seen_points;
    thread_local std::vector<float> seen;
    seen_points.resize(n), seen.assign(n, 0);
    for (int k = 0; k < 4; ++k)
      if (corners.weights[k] > 0)
        for (std::size_t s = 0; s < n; ++s)
          if (bit_of(chart.bits[l], corners.texels[k] * n + s)) seen[s] += corners.weights[k];
    const Vec3& p = point.receiver.position;
    float all = 0, part = 0;
    for (std::size_t s = 0; s < n; ++s) {
      const LightSample& sample = points.samples[s];
      const bool far = points.kind == EmitterKind::direction;
      const Vec3 to = normalize(far ? sample.position : sample.position - p);
      seen_points[s] = {to, static_cast<float>(n) * irradiance_of(points, sample, p, to), false};
      const float share = share_of(points, sample, p);
      all += share, part += share * seen[s];
    }
    LightArrival arrival = arrival_from(seen_points, seen, point.shading);
    arrival.visibility = {all > 0 ? part / all : 0, 0};
    return arrival;
  }

  StoreReader reader;  // keeps the bytes that `samples` points into
  bool of_samples;
  std::vector<PageSize> pages;
  StoredSurface surface;
  std::vector<std::size_t> numbers;                               // by light of the scene
  std::vector<std::vector<std::vector<std::uint8_t>>> fractions;  // by light and page
  SampleFile samples;
  std::vector<std::vector<std::uint32_t>> chart_of;  // by instance and triangle
};

StoredLight::StoredLight(const std::string& file, const Scene& scene)
    : parts_(std::make_unique<Parts>(file, scene)) {}

StoredLight::~StoredLight() = default;

const char* StoredLight::what() const {
  return parts_->of_samples ? "samples" : "visible fractions";
}

void StoredLight::irradiances(std::size_t, std::span<const TilePoint>, std::span<float> out) const {
  std::ranges::fill(out, -1.0f);
}

void StoredLight::visible_fractions(std::size_t light, std::span<const TilePoint> points,
                                    std::span<float> out) const {
  std::vector<LightArrival> found(points.size());
  arrivals(light, points, std::vector<std::uint8_t>(points.size(), 1), found);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = found[i].visibility.fraction;
}

bool StoredLight::arrivals(std::size_t light, std::span<const TilePoint> points,
                           std::span<const std::uint8_t> asked, std::span<LightArrival> out) const {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!asked[i]) continue;
    const TilePoint& p = points[i];
    const auto at = parts_->surface.find(p.primitive, p.shading.position, p.normal);
    out[i] = {};
    if (!at) continue;
    if (parts_->of_samples) {
      out[i] = parts_->sampled(light, p, *at);
    } else {
      const float f = parts_->fraction(light, *at);
      out[i] = {f, f, {f, 0}};
    }
  }
  return true;
}

}  // namespace penumbra::bake
