#include "report/digest.h"

#include <cstring>

namespace penumbra::report {
namespace {

void add(Digest& d, const Affine& a) {
  for (const Vec3d& v : {a.x, a.y, a.z, a.t}) d.add(v.x), d.add(v.y), d.add(v.z);
}

void add(Digest& d, const TextureSlot& slot) {
  d.add(slot.image), d.add(slot.uv_set), d.add(slot.wrap_s), d.add(slot.wrap_t);
  d.add(slot.nearest), d.add(slot.rotation);
  for (const Vec2& v : {slot.offset, slot.scale}) d.add(v.x), d.add(v.y);
}

void add(Digest& d, const Material& m) {
  for (const Vec3& v : {m.diffuse, m.specular, m.mirror, m.emission}) d.add(v);
  for (const TextureSlot* slot : {&m.diffuse_map, &m.metallic_roughness_map, &m.emission_map})
    add(d, *slot);
  d.add(m.roughness), d.add(m.metallic), d.add(m.is_metallic_roughness), d.add(m.double_sided);
  d.add(m.alpha_cutoff.value_or(-1)), d.add(m.alpha), d.add(m.unlit);
}

void add(Digest& d, const Mesh& mesh) {
  d.add(mesh.positions), d.add(mesh.normals), d.add(mesh.uv[0]), d.add(mesh.uv[1]);
  d.add(mesh.colors), d.add(mesh.indices);
}

void add(Digest& d, const SdfTree& tree) {
  d.add(tree.object), d.add(tree.numbers);
  for (const SdfNode& n : tree.nodes) {
    d.add(n.op), d.add(n.profile), d.add(n.material), d.add(n.first_number);
    d.add(n.number_count), d.add(n.first_child), d.add(n.child_count);
  }
}

void add(Digest& d, const Light& l) {
  d.add(l.type);
  for (const Vec3& v : {l.position, l.normal, l.edge_u, l.edge_v, l.direction, l.emission})
    d.add(v);
  d.add(l.radius), d.add(l.angular_diameter), d.add(l.spot_cos_inner), d.add(l.spot_cos_outer);
  d.add(l.instance), d.add(l.double_sided);
}

void add(Digest& d, const Camera& c) {
  d.add(c.position), d.add(c.look_at), d.add(c.up), d.add(c.vertical_fov);
  d.add(c.ortho_height.value_or(-1));
}

}  // namespace

void Digest::add_bytes(const void* bytes, std::size_t size) {
  const auto* p = static_cast<const unsigned char*>(bytes);
  state_ = mix64(state_, size);
  for (; size > 0;) {
    std::uint64_t word = 0;
    const std::size_t n = std::min<std::size_t>(size, sizeof word);
    std::memcpy(&word, p, n);
    state_ = mix64(state_ ^ word);
    p += n, size -= n;
  }
}

std::uint64_t digest_of(const Scene& scene) {
  Digest d;
  for (const TextureImage& t : scene.textures) d.add(t.width), d.add(t.height), d.add(t.rgba);
  for (const Material& m : scene.materials) add(d, m);
  for (const Mesh& mesh : scene.meshes) add(d, mesh);
  for (const Instance& i : scene.instances) {
    d.add(i.mesh), d.add(i.material), d.add(i.object), d.add(i.mesh_light);
    add(d, i.world_from_mesh);
  }
  for (const Sphere& s : scene.spheres)
    d.add(s.center), d.add(s.radius), d.add(s.material), d.add(s.object);
  for (const SdfTree& tree : scene.sdfs) add(d, tree);
  for (const Light& light : scene.lights) add(d, light);
  for (const Camera& camera : scene.cameras) add(d, camera);
  d.add(scene.ambient), d.add(scene.ambient_is_automatic), d.add(scene.background);
  d.add(scene.exposure_ev.value_or(0)), d.add(scene.exposure_ev.has_value());
  return d.value();
}

}  // namespace penumbra::report
