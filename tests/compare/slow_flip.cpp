#include "compare/slow_flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace penumbra::test {
namespace {

const double pi = std::acos(-1.0);

struct Triple {
  double x, y, z;
};

// Chromaticities of Rec. 709's primaries and D65 (0.3127, 0.3290), as IEC 61966-2-1 has them:
// luminances of the primaries by Cramer's rule.
struct Primaries {
  Triple r{0.64 / 0.33, 1, 0.03 / 0.33}, g{0.30 / 0.60, 1, 0.10 / 0.60},
      b{0.15 / 0.06, 1, 0.79 / 0.06}, white{0.3127 / 0.3290, 1, 0.3583 / 0.3290};

  static double determinant(const Triple& a, const Triple& b, const Triple& c) {
    return a.x * (b.y * c.z - b.z * c.y) - b.x * (a.y * c.z - a.z * c.y) +
           c.x * (a.y * b.z - a.z * b.y);
  }
  Primaries() {
    const double d = determinant(r, g, b);
    const double lr = determinant(white, g, b) / d, lg = determinant(r, white, b) / d,
                 lb = determinant(r, g, white) / d;
    r = {r.x * lr, lr, r.z * lr};
    g = {g.x * lg, lg, g.z * lg};
    b = {b.x * lb, lb, b.z * lb};
  }
};
const Primaries primaries;

Triple xyz_from_rgb(const Triple& c) {
  const auto& [r, g, b, white] = primaries;
  return {(r.x * c.x + g.x * c.y + b.x * c.z) / white.x, r.y * c.x + g.y * c.y + b.y * c.z,
          (r.z * c.x + g.z * c.y + b.z * c.z) / white.z};
}

Triple rgb_from_xyz(const Triple& relative) {
  const auto& [r, g, b, white] = primaries;
  const Triple c{relative.x * white.x, relative.y, relative.z * white.z};
  const double d = Primaries::determinant(r, g, b);
  return {Primaries::determinant(c, g, b) / d, Primaries::determinant(r, c, b) / d,
          Primaries::determinant(r, g, c) / d};
}

Triple ycxcz_from_rgb(const Triple& rgb) {
  const Triple c = xyz_from_rgb(rgb);
  return {116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z)};
}

Triple rgb_from_ycxcz(const Triple& c) {
  const double y = (c.x + 16) / 116;
  return rgb_from_xyz({y + c.y / 500, y, y - c.z / 200});
}

double curve(double t) {
  return t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t * 29 * 29 / (3 * 36) + 4.0 / 29;
}

Triple hunt_lab(const Triple& rgb) {
  const Triple c = xyz_from_rgb(rgb);
  const double l = 116 * curve(c.y) - 16;
  return {l, l / 100 * 500 * (curve(c.x) - curve(c.y)), l / 100 * 200 * (curve(c.y) - curve(c.z))};
}

double hyab(const Triple& a, const Triple& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

double color_term(const Triple& rgb_a, const Triple& rgb_b) {
  const double qc = 0.7, pc = 0.4, pt = 0.95;
  const double cmax = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), qc);
  const double e = std::pow(hyab(hunt_lab(rgb_a), hunt_lab(rgb_b)), qc);
  return e < pc * cmax ? pt / (pc * cmax) * e
                       : pt + (e - pc * cmax) / (cmax - pc * cmax) * (1 - pt);
}

// A kernel of (2 radius + 1)² weights from a function of the offset in pixels.
struct Kernel2 {
  int radius;
  std::vector<double> weights;

  Kernel2(int r, const std::function<double(int, int)>& f) : radius(r) {
    for (int y = -r; y <= r; ++y)
      for (int x = -r; x <= r; ++x) weights.push_back(f(x, y));
  }
  // Positive weights to a sum of 1, negative ones to −1.
  Kernel2& normalize() {
    double positive = 0, negative = 0;
    for (double w : weights) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : weights)
      if (w != 0) w /= w > 0 ? positive : negative;
    return *this;
  }
  double at(const std::function<double(int, int)>& value, int x, int y, int width,
            int height) const {
    double sum = 0;
    std::size_t i = 0;
    for (int dy = -radius; dy <= radius; ++dy)
      for (int dx = -radius; dx <= radius; ++dx)
        sum += weights[i++] *
               value(std::clamp(x + dx, 0, width - 1), std::clamp(y + dy, 0, height - 1));
    return sum;
  }
};

Kernel2 sensitivity(double a1, double b1, double a2, double b2, double ppd) {
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
  const auto term = [&](double a, double b, double d2) {
    return a * std::sqrt(pi / b) * std::exp(-pi * pi * d2 / b);
  };
  return Kernel2(radius,
                 [&](int x, int y) {
                   const double d2 = (x * x + y * y) / (ppd * ppd);
                   return term(a1, b1, d2) + term(a2, b2, d2);
                 })
      .normalize();
}

class Picture {
 public:
  Picture(const Image& image, double ppd)
      : width_(image.width),
        height_(image.height),
        a_(sensitivity(1, 0.0047, 0, 1e-5, ppd)),
        rg_(sensitivity(1, 0.0053, 0, 1e-5, ppd)),
        by_(sensitivity(34.1, 0.04, 13.5, 0.025, ppd)) {
    for (std::size_t i = 0; i < image.data.size(); i += 3)
      pixels_.push_back(ycxcz_from_rgb({image.data[i], image.data[i + 1], image.data[i + 2]}));
  }
  Triple seen(int x, int y) const {
    const auto filtered = [&](const Kernel2& kernel, double Triple::*channel) {
      return kernel.at([&](int i, int j) { return pixels_[j * width_ + i].*channel; }, x, y, width_,
                       height_);
    };
    const Triple c = rgb_from_ycxcz(
        {filtered(a_, &Triple::x), filtered(rg_, &Triple::y), filtered(by_, &Triple::z)});
    return {std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)};
  }
  double feature(const Kernel2& along_x, const Kernel2& along_y, int x, int y) const {
    const auto value = [&](int i, int j) { return (pixels_[j * width_ + i].x + 16) / 116; };
    return std::hypot(along_x.at(value, x, y, width_, height_),
                      along_y.at(value, x, y, width_, height_));
  }

 private:
  int width_, height_;
  Kernel2 a_, rg_, by_;
  std::vector<Triple> pixels_;
};

struct Detectors {
  Kernel2 edge_x, edge_y, point_x, point_y;
};

Detectors detectors(double ppd) {
  const double sd = 0.5 * 0.082 * ppd;
  const int r = static_cast<int>(std::ceil(3 * sd));
  const auto g = [sd](int x, int y) { return std::exp(-(x * x + y * y) / (2 * sd * sd)); };
  const auto edge = [=](int x, int y) { return -x * g(x, y); };
  const auto point = [=](int x, int y) { return (x * x / (sd * sd) - 1) * g(x, y); };
  return {Kernel2(r, edge).normalize(),
          Kernel2(r, [=](int x, int y) { return edge(y, x); }).normalize(),
          Kernel2(r, point).normalize(),
          Kernel2(r, [=](int x, int y) { return point(y, x); }).normalize()};
}

}  // namespace

Image slow_flip(const Image& reference, const Image& test, double pixels_per_degree) {
  const Picture a(reference, pixels_per_degree), b(test, pixels_per_degree);
  const Detectors d = detectors(pixels_per_degree);
  Image map(reference.width, reference.height, 1);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const double edges =
          std::abs(a.feature(d.edge_x, d.edge_y, x, y) - b.feature(d.edge_x, d.edge_y, x, y));
      const double points =
          std::abs(a.feature(d.point_x, d.point_y, x, y) - b.feature(d.point_x, d.point_y, x, y));
      const double feature = std::pow(std::max(edges, points) / std::sqrt(2.0), 0.5);
      *map.at(x, y) =
          static_cast<float>(std::pow(color_term(a.seen(x, y), b.seen(x, y)), 1 - feature));
    }
  return map;
}

double slow_color_difference(const double (&a)[3], const double (&b)[3]) {
  return color_term({a[0], a[1], a[2]}, {b[0], b[1], b[2]});
}

}  // namespace penumbra::test
