// A light as the command line and scene files have it.
struct pnb_Light {
  int type;             // 0 point, 1 sphere, 2 disk, 3 rect, 4 segment, 5 sun, 6 mesh
  vec3 position;        // centre
  vec3 normal;          // unit: the side that emits; a sun's: towards it
  vec3 edge_u, edge_v;  // rect: whole edges; segment: end to end in u
  vec3 emission;        // radiance; point: intensity; sun: irradiance
  float radius;
  float sin2;           // sun: squared sine of half its angular diameter
  float diameter;       // D; a sun's: 2 tan(half its angular diameter)
  vec2 spot;            // point: cosine -> [0, 1] between outer and inner cone, scale and offset
  int mesh, own;        // mesh: first texel; the instance that does not block it. Others: -1
};

const float pnb_pi = 3.14159265;

// The angle of (x, y), y >= 0, to float precision (drivers' atan is good to 1e-5 only).
float pnb_angle(float x, float y) {
  bool back = x < 0.0;
  vec2 v = vec2(abs(x), y);
  for (int i = 0; i < 3; ++i) v.x += length(v);  // halves the angle
  float q = v.x > 0.0 ? v.y / v.x : 0.0, q2 = q * q;
  float a = 8.0 * q * (1.0 - q2 * (1.0 / 3.0 - q2 * (0.2 - q2 * (1.0 / 7.0 - q2 * (1.0 / 9.0)))));
  return back ? pnb_pi - a : a;
}

float pnb_arc_cosine(float x) { return pnb_angle(x, sqrt(max(0.0, 1.0 - x * x))); }

// A right-handed frame around a unit vector (Duff et al. 2017).
mat3 pnb_frame(vec3 w) {
  float s = w.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (s + w.z), b = w.x * w.y * a;
  return mat3(vec3(1.0 + s * w.x * w.x * a, s * b, -s * w.x), vec3(b, s + w.y * w.y * a, -w.y), w);
}
