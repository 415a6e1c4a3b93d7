#include "bake/sample_file.h"

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace penumbra::bake {
namespace {

constexpr std::string_view magic = "PNBS";
constexpr std::uint32_t version = 1;
constexpr std::uint32_t most_side = 16384, most_samples = 1 << 20;

/// ISO 3309, as in PNG.
std::uint32_t crc32(std::string_view bytes) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      t[i] = i;
      for (int k = 0; k < 8; ++k) t[i] = t[i] >> 1 ^ (t[i] & 1 ? 0xedb88320u : 0u);
    }
    return t;
  }();
  std::uint32_t crc = ~0u;
  for (const char c : bytes) crc = crc >> 8 ^ table[(crc ^ static_cast<unsigned char>(c)) & 255];
  return ~crc;
}

void put(std::string& out, std::uint32_t word) {
  out.append(reinterpret_cast<const char*>(&word), sizeof word);
}
void put(std::string& out, float number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}
void put(std::string& out, const Vec3& v) { put(out, v.x), put(out, v.y), put(out, v.z); }

std::string bytes_of(const SampledLight& light) {
  std::string out;
  put(out, static_cast<std::uint32_t>(light.kind));
  put(out, static_cast<std::uint32_t>(light.measure));
  put(out, static_cast<std::uint32_t>(light.two_sided));
  put(out, static_cast<std::uint32_t>(light.samples.size()));
  for (const LightSample& s : light.samples)
    put(out, s.position), put(out, s.normal), put(out, s.weight);
  return out;
}

class Parser {
 public:
  explicit Parser(std::string_view bytes) : bytes_(bytes) {}

  const char* take(std::uint64_t size) {
    if (size > bytes_.size() - at_) throw std::runtime_error("they end too early");
    const char* from = bytes_.data() + at_;
    at_ += size;
    return from;
  }
  std::uint32_t word() {
    std::uint32_t w;
    std::memcpy(&w, take(sizeof w), sizeof w);
    return w;
  }
  /// At most `most`.
  std::uint32_t word(std::uint32_t most) {
    const std::uint32_t w = word();
    if (w > most) throw std::runtime_error("they contradict themselves");
    return w;
  }
  float number() {
    float f;
    std::memcpy(&f, take(sizeof f), sizeof f);
    if (!std::isfinite(f)) throw std::runtime_error("a light point is not finite");
    return f;
  }
  Vec3 vector() {
    const float x = number(), y = number();
    return {x, y, number()};
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

SampledLight parse_list(Parser& in) {
  SampledLight light;
  light.kind = static_cast<EmitterKind>(in.word(3));
  light.measure = static_cast<FractionMeasure>(in.word(2));
  light.two_sided = in.word(1) == 1;
  const std::uint32_t count = in.word(most_samples);
  if (count > in.left() / 28) throw std::runtime_error("they end too early");
  light.samples.resize(count);
  for (LightSample& s : light.samples) {
    s.position = in.vector(), s.normal = in.vector();
    s.weight = in.number();
  }
  return light;
}

SampledChart parse_chart(Parser& in, std::size_t lights, std::size_t pages, std::size_t lists) {
  if (pages == 0 || (lists == 0 && lights > 0))
    throw std::runtime_error("they contradict themselves");
  SampledChart chart;
  chart.place.page = static_cast<int>(in.word(static_cast<std::uint32_t>(pages - 1)));
  chart.place.x = static_cast<int>(in.word(most_side));
  chart.place.y = static_cast<int>(in.word(most_side));
  chart.place.turned = in.word(1) == 1;
  chart.width = static_cast<int>(in.word(most_side));
  chart.height = static_cast<int>(in.word(most_side));
  if (chart.width == 0 || chart.height == 0) throw std::runtime_error("they contradict themselves");
  for (std::size_t l = 0; l < lights; ++l)
    chart.lists.push_back(in.word(static_cast<std::uint32_t>(lists - 1)));
  return chart;
}

}  // namespace

void SampleWriter::add(const ChartPlace& place, int width, int height, const ChartSight& sight) {
  for (const int n : {place.page, place.x, place.y, static_cast<int>(place.turned), width, height})
    put(charts_, static_cast<std::uint32_t>(n));
  for (std::size_t l = 0; l < lights_; ++l) {
    const auto [it, is_new] = known_.try_emplace(bytes_of(sight.lights[l]), list_count_);
    if (is_new) lists_ += it->first, ++list_count_;
    put(charts_, it->second);
    const auto& bits = sight.bits[l].bytes();
    bits_.append(reinterpret_cast<const char*>(bits.data()), bits.size());
  }
  ++chart_count_;
}

std::string SampleWriter::bytes() const {
  std::string out(magic);
  put(out, version), put(out, static_cast<std::uint32_t>(lights_));
  put(out, list_count_), put(out, chart_count_);
  out.reserve(out.size() + lists_.size() + charts_.size() + bits_.size() + 4);
  out += lists_, out += charts_, out += bits_;
  put(out, crc32(out));
  return out;
}

SampleFile parse_samples(std::string_view bytes, std::size_t lights, std::size_t pages) {
  if (bytes.size() < 24 || !bytes.starts_with(magic))
    throw std::runtime_error("they do not begin as samples do");
  Parser in(bytes.substr(0, bytes.size() - 4));
  in.take(magic.size());
  if (in.word() != version) throw std::runtime_error("they are of another version");
  std::uint32_t crc;
  std::memcpy(&crc, bytes.data() + bytes.size() - 4, sizeof crc);
  if (crc != crc32(bytes.substr(0, bytes.size() - 4)))
    throw std::runtime_error("their checksum differs");
  if (in.word() != lights) throw std::runtime_error("they are of another number of lights");
  const std::uint32_t lists = in.word(), charts = in.word();
  SampleFile file;
  for (std::uint32_t i = 0; i < lists; ++i) file.lists.push_back(parse_list(in));
  for (std::uint32_t i = 0; i < charts; ++i)
    file.charts.push_back(parse_chart(in, lights, pages, file.lists.size()));
  for (SampledChart& chart : file.charts)
    for (const std::uint32_t list : chart.lists) {
      const std::uint64_t bits = static_cast<std::uint64_t>(chart.width) *
                                 static_cast<std::uint64_t>(chart.height) *
                                 file.lists[list].samples.size();
      chart.bits.push_back(reinterpret_cast<const std::uint8_t*>(in.take((bits + 7) / 8)));
    }
  if (in.left() != 0) throw std::runtime_error("they go on after their end");
  return file;
}

}  // namespace penumbra::bake
