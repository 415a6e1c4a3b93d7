#include "app/golden.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "base/atomic_file.h"
#include "compare/error_map.h"
#include "compare/flip.h"
#include "compare/picture_errors.h"
#include "image/png.h"
#include "image/srgb.h"

namespace penumbra::test {
namespace {

const std::string kFolder = PENUMBRA_SOURCE_DIR "/tests/data/golden/";

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// NAME SCENE OPTIONS, or NAME SCENE OPTIONS | of the golden picture | of the test.
Golden golden_of(const std::string& line) {
  const std::size_t bar = line.find('|');
  std::vector<std::string> words = words_of(line.substr(0, bar));
  if (bar != line.npos)
    for (const std::string& word : words_of(line.substr(line.rfind('|') + 1)))
      words.push_back(word);
  Golden golden{
      words.at(0),
      {"render", PENUMBRA_SOURCE_DIR "/scenes/" + words.at(1), "--size", "96x60", "--quiet"}};
  golden.command.insert(golden.command.end(), words.begin() + 2, words.end());
  return golden;
}

std::vector<Golden> list(const std::string& file) {
  std::istringstream in(read_file(kFolder + file));
  std::vector<Golden> all;
  for (std::string line; std::getline(in, line);)
    if (!line.starts_with('#')) all.push_back(golden_of(line));
  return all;
}

double gray(const float* pixel) { return (double{pixel[0]} + pixel[1] + pixel[2]) / 3; }

bool is_clipped(const float* pixel) { return *std::max_element(pixel, pixel + 3) >= 0.999f; }

// How far apart neighbouring codes are in linear light.
double step_at(double linear) {
  const double code = srgb_from_linear(std::clamp(linear, 0.0, 1.0));
  return linear_from_srgb(std::min(code + 1.0 / 255, 1.0)) -
         linear_from_srgb(std::min(code, 254.0 / 255));
}

struct Scatter {
  double squares = 0;   // of the mean's distance from the golden picture
  double variance = 0;  // of the mean
  void add(const std::vector<Image>& candidates, const Image& golden, std::size_t i) {
    const auto count = static_cast<double>(candidates.size());
    double sum = 0, sum_of_squares = 0;
    for (const Image& candidate : candidates) {
      const double value = gray(candidate.data.data() + i);
      sum += value;
      sum_of_squares += value * value;
    }
    const double mean = sum / count;
    const double error = mean - gray(golden.data.data() + i);
    const double rounding = 0.5 * step_at(mean);
    squares += error * error;
    variance +=
        std::max(0.0, sum_of_squares / count - mean * mean) / (count - 1) + rounding * rounding;
  }
};

}  // namespace

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name; }

std::vector<Golden> exact_pictures() { return list("exact.txt"); }
std::vector<Golden> sampled_pictures() { return list("sampled.txt"); }

Image read_rgb(const std::string& file) {
  const Image rgba = read_png(file);
  Image rgb(rgba.width, rgba.height, 3);
  for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] = rgba.data[i / 3 * 4 + i % 3];
  return rgb;
}

Image golden_picture(const std::string& name) { return read_rgb(kFolder + name + ".png"); }

std::string failure_folder(const std::string& name) {
  const auto bin = std::filesystem::path(PENUMBRA_PROGRAM).parent_path();
  return (bin.parent_path() / "golden-failures" / name).string();
}

std::string leave_pictures(const std::string& folder, const Image& candidate,
                           const Image& reference) {
  std::filesystem::create_directories(folder);
  write_png(folder + "/candidate.png", candidate);
  write_png(folder + "/reference.png", reference);
  write_png(folder + "/difference.png", magnitude_map(flip_map(reference, candidate)));
  return "see candidate.png, reference.png and difference.png in " + folder +
         "; scripts/golden renews the references";
}

// The same program gives the same bytes. Another compiler or processor rounds otherwise: about one
// code in a thousand becomes its neighbour, an RMSE of 1e-4, and a ray that grazes an edge may go
// past it, which changes a quarter of a pixel (4 samples) by any amount, once in some pictures. So
// a thousandth of the pixels, 5, may be off by more than two codes, and the rest is held to an RMSE
// of 5e-4 and a FLIP of 1.5e-3. The closest published variants, the cubic and the sine profile, are
// 7e-4 and 2.1e-3 apart.
std::string objection(const Image& candidate, const Image& golden) {
  if (candidate.width != golden.width || candidate.height != golden.height)
    return "the size is another";
  Image mended = candidate;
  int far_off = 0;
  for (int y = 0; y < golden.height; ++y)
    for (int x = 0; x < golden.width; ++x) {
      float* pixel = mended.at(x, y);
      const auto is_off = [&](int c) {
        return std::abs(srgb_from_linear(pixel[c]) - srgb_from_linear(golden.at(x, y)[c])) >
               2.5 / 255;
      };
      if (!is_off(0) && !is_off(1) && !is_off(2)) continue;
      ++far_off;
      std::copy_n(golden.at(x, y), 3, pixel);
    }
  const double rmse = picture_errors(golden, mended, PictureKind::display).rmse;
  const double flip = mean_value(flip_map(golden, mended));
  if (far_off <= 5 && rmse <= 5e-4 && flip <= 1.5e-3) return {};
  std::ostringstream text;
  text << far_off << " pixels are off by more than two codes (5 may), the others by an RMSE of "
       << rmse << " (5e-4) and a mean FLIP of " << flip << " (1.5e-3)";
  return text.str();
}

// The mean of K candidates is off by the variance of its mean, s² / K, and by at most half a code
// of the golden picture. Summed over the pixels, the square of its distance over that variance is
// at most 1 for an estimator without bias. The noise of `area` differs from pixel to pixel, which
// leaves little scatter in that ratio; `heckbert-herf` has the same points for all texels, which
// leaves that of few degrees of freedom: at K = 6, Student's t with 5 has t² < 4 at 90 %. Seeds are
// fixed, so the ratio is the same in each run: 0.2 to 0.95. A light that is a fifth larger is seen.
std::string statistical_objection(const std::vector<Image>& candidates, const Image& golden) {
  Scatter scatter;
  for (std::size_t i = 0; i < golden.data.size(); i += 3) {
    bool clipped = is_clipped(golden.data.data() + i);
    for (const Image& candidate : candidates) clipped |= is_clipped(candidate.data.data() + i);
    if (!clipped) scatter.add(candidates, golden, i);
  }
  const double ratio = scatter.squares / scatter.variance;
  if (ratio <= 4) return {};
  std::ostringstream text;
  text << "the square of the distance is " << ratio << " times the variance of the mean (4 may be)";
  return text.str();
}

Image mean_of(const std::vector<Image>& pictures) {
  Image mean(pictures.front().width, pictures.front().height, 3);
  for (const Image& picture : pictures)
    for (std::size_t i = 0; i < mean.data.size(); ++i)
      mean.data[i] += picture.data[i] / static_cast<float>(pictures.size());
  return mean;
}

}  // namespace penumbra::test
