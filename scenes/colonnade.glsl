// A colonnade round a pool of blobs that rise and sink with iTime: a map() as it stands on
// Shadertoy, with macros, helper functions, a loop, and a repeated domain.
//   penumbra render scenes/colonnade.glsl -o colonnade.png --shadows sdf-inner --time 2
#define BLOBS 5
#define rot(a) mat2(cos(a), -sin(a), sin(a), cos(a))

const float spacing = 0.9;

float smin(float a, float b, float k) {
  float h = max(k - abs(a - b), 0.0);
  return min(a, b) - h * h * 0.25 / k;
}

float sdBox(vec3 p, vec3 b) {
  vec3 q = abs(p) - b;
  return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

float sdCappedCylinder(vec3 p, float h, float r) {
  vec2 d = abs(vec2(length(p.xz), p.y)) - vec2(r, h);
  return min(max(d.x, d.y), 0.0) + length(max(d, 0.0));
}

// Columns stand at the corners of a grid, from -1 to 1 along both axes, none in the middle.
float columns(vec3 p) {
  float d = 1e9;
  vec2 id = clamp(round(p.xz / spacing), -1.0, 1.0);
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++) {
      vec2 n = clamp(id + vec2(i, j), -1.0, 1.0);
      if (n == vec2(0.0)) continue;
      vec3 q = p - vec3(spacing * n.x, 0.5, spacing * n.y);
      d = min(d, sdCappedCylinder(q, 0.5, 0.09));
      d = min(d, sdBox(q - vec3(0.0, 0.5, 0.0), vec3(0.14, 0.04, 0.14)));
    }
  return d;
}

float blobs(vec3 p) {
  float d = 1e9;
  for (int i = 0; i < BLOBS; i++) {
    float a = 6.2831853 * float(i) / float(BLOBS);
    vec3 c = vec3(0.0, 0.3 + 0.15 * sin(iTime + a), 0.0);
    c.xz = rot(a + 0.3 * iTime) * vec2(0.2, 0.0);
    d = smin(d, length(p - c) - 0.15, 0.12);
  }
  return d;
}

float map(vec3 p) { return min(p.y, min(columns(p), blobs(p))); }

vec3 albedo(vec3 p) {
  if (p.y < 0.001) {
    vec2 c = floor(2.0 * p.xz);
    return vec3(mod(c.x + c.y, 2.0) < 0.5 ? 0.75 : 0.55);
  }
  return blobs(p) < columns(p) ? vec3(0.8, 0.35, 0.2) : vec3(0.75, 0.72, 0.65);
}
