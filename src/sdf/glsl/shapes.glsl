// Distances of shapes and ways to join them, after Inigo Quilez (iquilezles.org/articles: distance
// functions in 3-D and 2-D, smooth minimum). Negative inside.

float pnb_corner(vec2 d) { return length(max(d, 0.0)) + min(max(d.x, d.y), 0.0); }

float pnb_sd_sphere(vec3 p, float radius) { return length(p) - radius; }

float pnb_sd_box(vec3 p, vec3 half_size) {
  vec3 q = abs(p) - half_size;
  return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

float pnb_sd_round_box(vec3 p, vec3 half_size, float radius) {
  return pnb_sd_box(p, half_size - radius) - radius;
}

// A bound; inside, where Quilez's has no bounded slope, (k0 - 1) times the least radius.
float pnb_sd_ellipsoid(vec3 p, vec3 radii) {
  float k0 = length(p / radii), k1 = length(p / (radii * radii));
  float least = min(radii.x, min(radii.y, radii.z));
  return k0 < 1.0 ? (k0 - 1.0) * least : k0 * (k0 - 1.0) / max(k1, 1e-30);
}

float pnb_sd_torus(vec3 p, float major, float minor) {
  return length(vec2(length(p.xz) - major, p.y)) - minor;
}

// sc: sine and cosine of the aperture.
float pnb_sd_capped_torus(vec3 p, vec2 sc, float major, float minor) {
  p.x = abs(p.x);
  float k = sc.y * p.x > sc.x * p.y ? dot(p.xy, sc) : length(p.xy);
  return sqrt(max(dot(p, p) + major * major - 2.0 * major * k, 0.0)) - minor;
}

float pnb_sd_capsule(vec3 p, vec3 from, vec3 to, float radius) {
  vec3 pa = p - from, ba = to - from;
  return length(pa - ba * clamp(dot(pa, ba) / dot(ba, ba), 0.0, 1.0)) - radius;
}

float pnb_sd_cylinder(vec3 p, float half_height, float radius) {
  return pnb_corner(vec2(length(p.xz) - radius, abs(p.y) - half_height));
}

float pnb_sd_capped_cone(vec3 p, float h, float bottom, float top) {
  vec2 q = vec2(length(p.xz), p.y), k1 = vec2(top, h), k2 = vec2(top - bottom, 2.0 * h);
  vec2 ca = vec2(q.x - min(q.x, q.y < 0.0 ? bottom : top), abs(q.y) - h);
  vec2 cb = q - k1 + k2 * clamp(dot(k1 - q, k2) / dot(k2, k2), 0.0, 1.0);
  float s = cb.x < 0.0 && ca.y < 0.0 ? -1.0 : 1.0;
  return s * sqrt(min(dot(ca, ca), dot(cb, cb)));
}

// The apex at the origin, the base of that radius at y = -height.
float pnb_sd_cone(vec3 p, float radius, float height) {
  vec2 q = vec2(radius, -height), w = vec2(length(p.xz), p.y);
  vec2 a = w - q * clamp(dot(w, q) / dot(q, q), 0.0, 1.0);
  vec2 b = vec2(w.x - min(w.x, radius), w.y + height);
  float outside = max(w.x * height + w.y * radius, -(w.y + height));
  float d = sqrt(min(dot(a, a), dot(b, b)));
  return outside < 0.0 ? -d : d;
}

float pnb_sd_plane(vec3 p, vec3 normal, float offset) { return dot(p, normal) - offset; }

// Along z; the radius of the circle inside.
float pnb_sd_hexagonal_prism(vec3 p, float radius, float half_height) {
  const vec3 k = vec3(-0.866025404, 0.5, 0.577350269);
  vec2 q = abs(p.xy);
  q -= 2.0 * min(dot(k.xy, q), 0.0) * k.xy;
  vec2 to = q - vec2(clamp(q.x, -k.z * radius, k.z * radius), radius);
  return pnb_corner(vec2(length(to) * (q.y < radius ? -1.0 : 1.0), abs(p.z) - half_height));
}

float pnb_sd_octahedron(vec3 p, float radius) {
  p = abs(p);
  float m = p.x + p.y + p.z - radius;
  vec3 q;
  if (3.0 * p.x < m) q = p.xyz;
  else if (3.0 * p.y < m) q = p.yzx;
  else if (3.0 * p.z < m) q = p.zxy;
  else return m * 0.577350269;
  float k = clamp(0.5 * (q.z - q.y + radius), 0.0, radius);
  return length(vec3(q.x, q.y - radius + k, q.z - k));
}

float pnb_sd_link(vec3 p, float half_length, float major, float minor) {
  float y = max(abs(p.y) - half_length, 0.0);
  return length(vec2(length(vec2(p.x, y)) - major, p.z)) - minor;
}

float pnb_sd_circle(vec2 p, float radius) { return length(p) - radius; }

float pnb_sd_rectangle(vec2 p, vec2 half_size) { return pnb_corner(abs(p) - half_size); }

float pnb_extruded(float d, float z, float half_height) {
  return pnb_corner(vec2(d, abs(z) - half_height));
}

vec2 pnb_revolved(vec3 p, float offset) { return vec2(length(p.xz) - offset, p.y); }

// A flat outline in space: its distance in its own plane, the height over that.
float pnb_sheet(float d, float height) { return length(vec2(max(d, 0.0), height)); }

float pnb_smooth_min(float a, float b, float k) {
  float h = max(k - abs(a - b), 0.0);
  return min(a, b) - h * h * 0.25 / k;
}

float pnb_smooth_max(float a, float b, float k) {
  float h = max(k - abs(a - b), 0.0);
  return max(a, b) + h * h * 0.25 / k;
}

// How much of the second shows where two blend (Quilez, smooth minimum: mix factor).
float pnb_share(float a, float b, float k) {
  float h = max(1.0 - abs(a - b) / k, 0.0), m = 0.5 * h * h;
  return a < b ? m : 1.0 - m;
}

// The nearest of copies that stand every `spacing` (0: none along this axis), up to `limit` to
// either side; `next` 1: the one beside it, on the point's side.
vec3 pnb_copy(vec3 p, vec3 spacing, vec3 limit, vec3 next) {
  for (int i = 0; i < 3; ++i) {
    if (spacing[i] <= 0.0) continue;
    float id = clamp(floor(p[i] / spacing[i] + 0.5), -limit[i], limit[i]);
    if (next[i] > 0.0) id = clamp(id + (p[i] < spacing[i] * id ? -1.0 : 1.0), -limit[i], limit[i]);
    p[i] -= spacing[i] * id;
  }
  return p;
}

float pnb_nearer(float a, float b) { return abs(a) < abs(b) ? a : b; }

// Pulls v back to `reach` from the origin; z: how far it was beyond.
vec3 pnb_pulled(vec2 v, float reach) {
  float r = length(v);
  return vec3(v * (r > reach ? reach / r : 1.0), max(r - reach, 0.0));
}

vec2 pnb_turned(vec2 v, float angle) {
  float c = cos(angle), s = sin(angle);
  return vec2(c * v.x + s * v.y, c * v.y - s * v.x);
}

// d beyond the cylinder within which something was turned; e: how far beyond.
float pnb_beyond(float e, float d) {
  return e > 0.0 ? length(vec2(e, max(d, 0.0))) : d;
}
