#include "compare/flip.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "base/parallel.h"
#include "compare/flip_color.h"
#include "compare/flip_filters.h"
#include "compare/sums.h"

namespace penumbra {
namespace {

struct Filters {
  ContrastFilters contrast;
  FeatureFilters feature;
  int margin;  // the greatest radius
};

Filters filters_for(float pixels_per_degree) {
  Filters f{contrast_filters(pixels_per_degree), feature_filters(pixels_per_degree), 0};
  f.margin = f.feature.gaussian.radius();
  for (const Kernel* kernel : {&f.contrast.achromatic, &f.contrast.red_green,
                               &f.contrast.blue_yellow[0], &f.contrast.blue_yellow[1]})
    f.margin = std::max(f.margin, kernel->radius());
  return f;
}

// Rows of a picture as opponent colours.
struct Band {
  Plane y, cx, cz;
  Band(int width, int height) : y(width, height), cx(width, height), cz(width, height) {}
};

Color3 unit_color(const float* pixel, int channels) {
  Color3 rgb;
  for (int c = 0; c < 3; ++c) {
    const float value = pixel[channels < 3 ? 0 : c];
    rgb[c] = value > 0 ? std::min(value, 1.0f) : 0;
  }
  return rgb;
}

void replicate_ends(float* row, int width, int margin) {
  std::fill_n(row, margin, row[margin]);
  std::fill_n(row + margin + width, margin, row[margin + width - 1]);
}

void read_row(const Image& image, int from, int margin, Band& band, int to) {
  float *y = band.y.row(to), *cx = band.cx.row(to), *cz = band.cz.row(to);
  const float* pixel = image.at(0, from);
  for (int x = margin; x < margin + image.width; ++x, pixel += image.channels) {
    const Color3 color = opponent_from_rgb(unit_color(pixel, image.channels));
    y[x] = color[0];
    cx[x] = color[1];
    cz[x] = color[2];
  }
  for (float* row : {y, cx, cz}) replicate_ends(row, image.width, margin);
}

// Rows [first, last) and `margin` more on all sides, where the border's pixels are repeated.
Band read_band(const Image& image, int first, int last, int margin) {
  Band band(image.width + 2 * margin, last - first + 2 * margin);
  for (int row = 0; row < band.y.height; ++row)
    read_row(image, std::clamp(first - margin + row, 0, image.height - 1), margin, band, row);
  return band;
}

Plane squared_filter(const Plane& in, const Kernel& kernel, int margin) {
  return filtered_columns(filtered_rows(in, kernel, margin), kernel, margin);
}

void add(const Plane& in, Plane& sum) {
  for (std::size_t i = 0; i < in.values.size(); ++i) sum.values[i] += in.values[i];
}

// What the eye sees of the colours, left in y, cx, cz as L*, a*, b* with the Hunt effect.
Band seen_colors(const Band& in, const Filters& filters) {
  const int m = filters.margin;
  Band out(0, 0);
  out.y = squared_filter(in.y, filters.contrast.achromatic, m);
  out.cx = squared_filter(in.cx, filters.contrast.red_green, m);
  out.cz = squared_filter(in.cz, filters.contrast.blue_yellow[0], m);
  add(squared_filter(in.cz, filters.contrast.blue_yellow[1], m), out.cz);
  for (std::size_t i = 0; i < out.y.values.size(); ++i) {
    const Color3 lab =
        hunt_lab_from_opponent({out.y.values[i], out.cx.values[i], out.cz.values[i]});
    out.y.values[i] = lab[0];
    out.cx.values[i] = lab[1];
    out.cz.values[i] = lab[2];
  }
  return out;
}

// The lengths of the vectors (x, y), left in x.
Plane lengths(Plane x, const Plane& y) {
  for (std::size_t i = 0; i < x.values.size(); ++i)
    x.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
  return x;
}

struct Features {
  Plane edges, points;
};

Features features_of(const Plane& y, const Filters& filters) {
  const int m = filters.margin;
  const FeatureFilters& f = filters.feature;
  const Plane smooth = filtered_rows(y, f.gaussian, m);
  return {lengths(filtered_columns(filtered_rows(y, f.edge, m), f.gaussian, m),
                  filtered_columns(smooth, f.edge, m)),
          lengths(filtered_columns(filtered_rows(y, f.point, m), f.gaussian, m),
                  filtered_columns(smooth, f.point, m))};
}

float feature_difference(const Features& a, const Features& b, std::size_t i) {
  const float greater = std::max(std::abs(a.edges.values[i] - b.edges.values[i]),
                                 std::abs(a.points.values[i] - b.points.values[i]));
  // The exponent qf is a half.
  return std::min(std::sqrt(greater * std::sqrt(0.5f)), 1.0f);
}

void flip_band(const Image& reference, const Image& test, int first, int last,
               const Filters& filters, float* out) {
  const Band a = read_band(reference, first, last, filters.margin);
  const Band b = read_band(test, first, last, filters.margin);
  const Features features_a = features_of(a.y, filters), features_b = features_of(b.y, filters);
  const Band colors_a = seen_colors(a, filters), colors_b = seen_colors(b, filters);
  const std::size_t count = static_cast<std::size_t>(last - first) * reference.width;
  for (std::size_t i = 0; i < count; ++i) {
    const float color =
        color_difference({colors_a.y.values[i], colors_a.cx.values[i], colors_a.cz.values[i]},
                         {colors_b.y.values[i], colors_b.cx.values[i], colors_b.cz.values[i]});
    out[i] = std::pow(color, 1 - feature_difference(features_a, features_b, i));
  }
}

}  // namespace

Image flip_map(const Image& reference, const Image& test, float pixels_per_degree) {
  assert(reference.width == test.width && reference.height == test.height);
  const Filters filters = filters_for(pixels_per_degree);
  Image map(reference.width, reference.height, 1);
  // Tall enough that reading the margins again costs little.
  const int rows = std::max(64, 2 * filters.margin);
  const int bands = (map.height + rows - 1) / rows;
  parallel_for(bands, [&](std::size_t band) {
    const int first = static_cast<int>(band) * rows;
    flip_band(reference, test, first, std::min(first + rows, map.height), filters,
              map.at(0, first));
  });
  return map;
}

double mean_value(const Image& image) {
  const std::size_t count = image.data.size();
  if (count == 0) return 0;
  return sum_blocks<double>(count,
                            [&](std::size_t first, std::size_t last) {
                              double sum = 0;
                              for (std::size_t i = first; i < last; ++i) sum += image.data[i];
                              return sum;
                            }) /
         static_cast<double>(count);
}

}  // namespace penumbra
