#include "shadow/mesh_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "shadow/textured_faces.h"

namespace penumbra {
namespace {

constexpr std::uint32_t leaf_size = 4;

std::array<float, 3> key(const Vec3& p) { return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}; }

bool is_closed(const Mesh& mesh) {
  using Edge = std::pair<std::array<float, 3>, std::array<float, 3>>;
  std::map<Edge, int> balance;  // +1 one way, −1 the other
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto a = key(mesh.positions[mesh.indices[i]]);
    const auto b = key(mesh.positions[mesh.indices[next]]);
    if (a != b) balance[std::minmax(a, b)] += a < b ? 1 : -1;
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
}

bool is_flat(const std::vector<LightFace>& faces) {
  if (faces.empty()) return false;
  Bounds bounds;
  for (const LightFace& f : faces)
    for (const Vec3& p : {f.a, f.b, f.c}) bounds.grow(p);
  const float slack = 1e-5f * bounds.diagonal();
  const LightFace& first = faces.front();
  return std::all_of(faces.begin(), faces.end(), [&](const LightFace& f) {
    const auto off = [&](const Vec3& p) {
      return std::abs(dot(first.normal, p - first.a)) > slack;
    };
    return dot(f.normal, first.normal) > 0.999f && !off(f.a) && !off(f.b) && !off(f.c);
  });
}

Vec3 center_of(const LightFace& f) { return (f.a + f.b + f.c) / 3; }

}  // namespace

MeshLight::MeshLight(const Scene& scene, const Light& light) {
  const Instance& instance = scene.instances[static_cast<std::size_t>(light.instance)];
  const Mesh& mesh = scene.meshes[instance.mesh];
  is_textured = instance.material < scene.materials.size() &&
                scene.materials[instance.material].emission_map.used();
  if (is_textured)
    faces = textured_faces(scene, light);
  else
    add_faces(mesh, instance.world_from_mesh);
  if (!faces.empty()) {
    build(0, static_cast<std::uint32_t>(faces.size()));
    const Sum& all = nodes_.front().sum;
    center = all.moment / all.area;
    for (const LightFace& f : faces)
      for (const Vec3& p : {f.a, f.b, f.c}) radius = std::max(radius, length(p - center));
  }
  double sum = 0;
  areas.reserve(faces.size());
  for (const LightFace& f : faces) areas.push_back(static_cast<float>(sum += double(f.area)));
  flat = is_flat(faces);
  closed = is_closed(mesh);
}

void MeshLight::add_faces(const Mesh& mesh, const Affine& world_from_mesh) {
  const float side = world_from_mesh.determinant() < 0 ? -1.0f : 1.0f;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const auto corner = [&](std::size_t i) {
      return world_from_mesh.point(mesh.positions[mesh.indices[3 * t + i]]);
    };
    LightFace face{corner(0), corner(1), corner(2), {}};
    const Vec3 n = cross(face.b - face.a, face.c - face.a);
    const float len = length(n);
    if (!(len > 0)) continue;
    face.normal = n * (side / len);
    face.area = len / 2;
    faces.push_back(face);
  }
}

void MeshLight::build(std::uint32_t first, std::uint32_t last) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  nodes_[index].first = first, nodes_[index].last = last;
  bound(nodes_[index]);
  if (last - first <= leaf_size) return;
  Bounds centers;
  for (std::uint32_t i = first; i < last; ++i) centers.grow(center_of(faces[i]));
  const Vec3 size = centers.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(faces.begin() + first, faces.begin() + middle, faces.begin() + last,
                   [axis](const LightFace& a, const LightFace& b) {
                     return center_of(a)[axis] < center_of(b)[axis];
                   });
  build(first, middle);
  nodes_[index].second = static_cast<std::uint32_t>(nodes_.size());
  build(middle, last);
}

void MeshLight::bound(Node& node) const {
  Bounds box;
  Vec3 normals;
  double area = 0;
  Vec3d moment;
  for (std::uint32_t i = node.first; i < node.last; ++i) {
    const LightFace& f = faces[i];
    for (const Vec3& p : {f.a, f.b, f.c}) box.grow(p);
    normals += f.normal;
    area += double(f.area), moment += Vec3d(center_of(f)) * double(f.area);
  }
  node.center = box.center(), node.radius = box.diagonal() / 2;
  node.sum = {static_cast<float>(area), Vec3(moment)};
  const float len = length(normals);
  if (!(len > 0)) {
    node.cosine = -1;
    return;
  }
  node.axis = normals / len;
  for (std::uint32_t i = node.first; i < node.last; ++i)
    node.cosine = std::min(node.cosine, dot(node.axis, faces[i].normal));
  // Wider by some roundings: near 0 the cosine of an angle says little about it.
  node.cosine = std::max(node.cosine - 1e-5f, -1.0f);
  node.sine = std::sqrt(std::max(0.0f, 1 - node.cosine * node.cosine));
}

void MeshLight::write_texels(std::vector<float>& nodes, std::vector<float>& face_texels) const {
  const auto add = [](std::vector<float>& to, const Vec3& v, float w) {
    to.insert(to.end(), {v.x, v.y, v.z, w});
  };
  std::vector<std::uint32_t> skip(nodes_.size(), static_cast<std::uint32_t>(nodes_.size()));
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const bool leaf = node.second == 0;
    if (!leaf) skip[i + 1] = node.second, skip[node.second] = skip[i];
    add(nodes, node.center, node.radius), add(nodes, node.axis, node.cosine);
    add(nodes, node.sum.moment, node.sum.area);
    add(nodes, {float(node.first), float(node.last), float(skip[i])}, leaf ? 1.0f : 0.0f);
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const LightFace& f = faces[i];
    add(face_texels, f.a, f.area), add(face_texels, f.b, areas[i]);
    add(face_texels, f.c, 0), add(face_texels, f.normal, 0);
  }
}

/// One walk through the tree.
class MeshLight::Search {
 public:
  Search(const MeshLight& light, const Vec3& point, std::vector<Run>* runs)
      : light_(light), point_(point), runs_(runs) {}

  Sum sum() const { return {static_cast<float>(area_), Vec3(moment_)}; }

  void visit(std::uint32_t index) {
    const Node& node = light_.nodes_[index];
    const Vec3 way = point_ - node.center;
    // Rounding of way and of the faces' corners is far below 1e-5 of either.
    const float away = length(way), slack = node.radius + 1e-5f * (away + node.radius);
    const float along = dot(way, node.axis);
    const float across = std::sqrt(std::max(0.0f, away * away - along * along));
    // |way| times the cosines of the angles between it and the normals nearest to it and furthest
    // from it.
    const bool around = along >= node.cosine * away;
    const bool behind = -along >= node.cosine * away;
    const float most = around ? away : along * node.cosine + across * node.sine;
    const float least = behind ? -away : along * node.cosine - across * node.sine;
    if (least > slack) return take(node);
    if (most < -slack) return;
    if (node.second == 0) return look(node);
    visit(index + 1), visit(node.second);
  }

  void take(const Node& node) { take(node.first, node.last, node.sum); }

 private:
  void take(std::uint32_t first, std::uint32_t last, const Sum& sum) {
    area_ += double(sum.area), moment_ += Vec3d(sum.moment);
    if (!runs_) return;
    if (runs_->empty() || runs_->back().last != first) runs_->push_back({first, last, 0});
    runs_->back().last = last, runs_->back().area = static_cast<float>(area_);
  }

  void look(const Node& node) {
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      const LightFace& f = light_.faces[i];
      if (turned(f, point_)) take(i, i + 1, {f.area, center_of(f) * f.area});
    }
  }

  const MeshLight& light_;
  Vec3 point_;
  std::vector<Run>* runs_;
  double area_ = 0;
  Vec3d moment_;
};

MeshLight::Sum MeshLight::seen_from(const Vec3& point, bool double_sided,
                                    std::vector<Run>* runs) const {
  if (runs) runs->clear();
  if (nodes_.empty()) return {};
  Search search(*this, point, runs);
  // Of a flat mesh all faces are turned to the point or none, and either way all count.
  if (!flat && (!double_sided || closed)) search.visit(0);
  if (!(search.sum().area > 0)) search.take(nodes_.front());
  return search.sum();
}

}  // namespace penumbra
