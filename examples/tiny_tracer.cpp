// A whole ray tracer with soft shadows from one shadow ray a pixel:
//   tiny_tracer OUT.ppm [DIAMETER_OF_THE_LIGHT]
#include <penumbra/parker.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <vector>

namespace parker = penumbra::parker;
using parker::Vec;

Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec operator*(Vec a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec cross(Vec a, Vec b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec unit(Vec a) { return a * (1 / std::sqrt(dot(a, a))); }

struct Sphere {
  Vec center;
  float radius;
  Vec colour;
};
struct Hit {
  float t = 1e30f;
  Vec normal{0, 0, 0}, colour{0.55f, 0.65f, 0.8f};
  const void* object = nullptr;
};

const Vec light{-4, 5.5f, 2.2f}, eye{0, 2.6f, 7}, apex{1.9f, 1.5f, 0.2f};
const std::vector<Sphere> spheres = {{{-1.7f, 1, 0}, 1, {0.8f, 0.3f, 0.2f}},
                                     {{0.4f, 0.45f, 1.2f}, 0.45f, {0.9f, 0.7f, 0.3f}},
                                     {{0.1f, 1.9f, -1.4f}, 0.5f, {0.3f, 0.5f, 0.8f}}};
const std::vector<Vec> base = {{1, 0, 1.1f}, {2.8f, 0, 1.1f}, {2.8f, 0, -0.7f}, {1, 0, -0.7f}};

void hit_plane(Vec o, Vec v, Hit& hit) {
  const float t = -o.y / v.y;
  if (t > 0 && t < std::min(hit.t, 40.0f)) hit = {t, {0, 1, 0}, {0.8f, 0.8f, 0.8f}, &light};
}

void hit_sphere(Vec o, Vec v, const Sphere& s, Hit& hit) {
  const float b = dot(s.center - o, v), miss = dot(s.center - o, s.center - o) - b * b;
  const float t = b - std::sqrt(s.radius * s.radius - miss);  // NaN fails the next comparison
  if (t > 0 && t < hit.t) hit = {t, unit(o + v * t - s.center), s.colour, &s};
}

void hit_triangle(Vec o, Vec v, Vec a, Vec b, Vec c, Hit& hit) {
  const Vec n = cross(b - a, c - a), q = cross(a - o, v);
  const float scale = 1 / dot(n, v), t = dot(a - o, n) * scale;
  const float s = dot(c - a, q) * scale, r = -dot(b - a, q) * scale;
  if (s >= 0 && r >= 0 && s + r <= 1 && t > 0 && t < hit.t)
    hit = {t, unit(n), {0.5f, 0.7f, 0.4f}, &base};
}

/// The fraction of the light that is seen from a point of `self`, a convex object, which cannot
/// shadow its own lit side. Within an object and between them the least fraction counts.
float visible_fraction(Vec point, const void* self, float diameter) {
  const float distance = std::sqrt(dot(light - point, light - point));
  const parker::ShadowRay ray{point, unit(light - point), distance, diameter / distance};
  float seen = 1;
  const auto shade = [&](float tau) { seen = parker::composite_min(seen, parker::cubic(tau)); };
  for (const Sphere& s : spheres)
    if (&s != self) shade(parker::sphere_tau(ray, s.center, s.radius));
  for (size_t i = 0; i < 4 && self != &base; ++i)
    shade(parker::triangle_tau(ray, base[i], base[(i + 1) % 4], apex));
  return seen;
}

Vec radiance(Vec o, Vec v, float diameter) {
  Hit hit;
  hit_plane(o, v, hit);
  for (const Sphere& s : spheres) hit_sphere(o, v, s, hit);
  for (size_t i = 0; i < 4; ++i) hit_triangle(o, v, base[i], base[(i + 1) % 4], apex, hit);
  if (!hit.object) return hit.colour;
  const Vec point = o + v * hit.t;
  const float cosine = dot(hit.normal, unit(light - point));
  const float direct = cosine > 0 ? cosine * visible_fraction(point, hit.object, diameter) : 0;
  return hit.colour * (0.1f + 0.9f * direct);
}

int main(int count, char** args) {
  const int width = 480, height = 320;
  const float diameter = count > 2 ? std::strtof(args[2], nullptr) : 1.5f;
  std::ofstream out(count > 1 ? args[1] : "tiny_tracer.ppm", std::ios::binary);
  out << "P6 " << width << ' ' << height << " 255\n";
  for (int i = 0; i < width * height; ++i) {
    const int row = i / width, column = i % width;
    const float x = (float(column) + 0.5f) / height - 0.75f, y = 0.5f - float(row) / height;
    const Vec c = radiance(eye, unit({x, y - 0.3f, -1.1f}), diameter);
    for (float value : {c.x, c.y, c.z})
      out.put(char(255 * std::pow(std::min(value, 1.0f), 1 / 2.2f)));
  }
  return out.flush() ? 0 : 1;
}
