#include "report/folder.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>

#include "base/atomic_file.h"
#include "base/error.h"
#include "compare/error_map.h"
#include "image/png.h"
#include "image/srgb.h"
#include "report/results_json.h"

namespace penumbra {
std::string_view compare_page_text(std::string_view name);
}

namespace penumbra::report {
namespace {

constexpr const char* parts[] = {"pictures", "visibility", "errors", "data"};
constexpr float slate[] = {0.075f, 0.09f, 0.12f};  // linear

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += k <= bytes.size() - i ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

Image mean_of(const Fractions& fractions) {
  Image mean = fractions.front();
  for (std::size_t light = 1; light < fractions.size(); ++light)
    for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] += fractions[light].data[i];
  for (float& value : mean.data) value /= static_cast<float>(fractions.size());
  return mean;
}

/// As a string of JSON may say it too, and nothing in it can end the script that it stands in.
std::string inside_script(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

/// A zlib stream (RFC 1950).
std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()), &size,
            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  out.resize(size);
  return out;
}

}  // namespace

Image gray_of(const Fractions& fractions) {
  const Image mean = mean_of(fractions);
  Image out(mean.width, mean.height, 3);
  for (std::size_t i = 0; i < mean.data.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.data[3 * i + c] =
          std::isnan(mean.data[i]) ? slate[c] : static_cast<float>(linear_from_srgb(mean.data[i]));
  return out;
}

std::string data_script(const std::string& name, const Fractions& fractions) {
  std::string bytes;
  for (const Image& plane : fractions)
    for (const float f : plane.data)
      bytes += static_cast<char>(
          std::isnan(f) ? 255 : static_cast<int>(std::lround(std::clamp(f, 0.0f, 1.0f) * 254)));
  return fmt::format(
      "penumbraData(\"{}\", "
      "{{\"width\":{},\"height\":{},\"lights\":{},\"bits\":8,\"encoding\":\"deflate\",\"values\":"
      "\"{}\"}}"
      ");\n",
      name, fractions.front().width, fractions.front().height, fractions.size(),
      base64(deflated(bytes)));
}

std::string reference_file(const std::string& folder) {
  return (std::filesystem::path(folder) / "reference.bin").string();
}

void prepare_folder(const std::string& folder) {
  const std::filesystem::path path(folder);
  for (const char* part : parts) {
    std::error_code error;
    std::filesystem::create_directories(path / part, error);
    if (error)
      throw WorkError({(path / part).string()},
                      fmt::format("this folder cannot be made ({})", error.message()),
                      "choose another folder with -o");
    const AtomicFile can_be_written((path / part / "test").string());
  }
  const AtomicFile can_be_written((path / "results.json").string());
}

std::string page_with(const std::string& json) {
  constexpr std::string_view place = "@results@";
  std::string page(compare_page_text("page.html"));
  const std::size_t at = page.find(place);
  return page.replace(at, place.size(), inside_script(json));
}

void write_folder(const std::string& folder, const Comparison& c) {
  const auto file = [&](const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
  };
  const auto write = [&](const std::string& name, const Image& picture,
                         const Fractions& fractions) {
    write_png(file(picture_file(name)), picture, c.exposure_ev);
    write_png(file(visibility_file(name)), gray_of(fractions));
    write_file(file(data_file(name)), data_script(name, fractions));
  };
  const Fractions truth = fractions_of(c.reference);
  write("reference", c.reference.color, truth);
  const Image truth_mean = mean_of(truth);
  for (const MethodResult& m : c.methods) {
    if (!m.ok()) continue;
    const std::string name(m.call.text.name);
    write(name, m.measured.picture.color, m.measured.fractions);
    write_png(file(error_file(name)), signed_error_map(truth_mean, mean_of(m.measured.fractions)));
  }
  const std::string json = json_text(results_json(c));
  write_file(file("results.json"), json);
  write_file(file("index.html"), page_with(json));
}

}  // namespace penumbra::report
