// A disk on a plane, in closed form (Howell's configuration factors B-13 and B-15; across the
// horizon Lambert's contour along the arc that is left).

// Integral of 1 / (a + b cos phi) from 0 to phi.
float pnb_disk_angle(float a, float b, float s, float phi) {
  float turns = floor(phi / (2.0 * pnb_pi) + 0.5);
  float half_ = 0.5 * phi - pnb_pi * turns;
  float y = sqrt(max(0.0, (a - b) / (a + b))) * sin(half_), x = cos(half_);
  return 2.0 / s * (sign(y) * pnb_angle(x, abs(y)) + turns * pnb_pi);
}

float pnb_disk_irradiance(pnb_Light l, vec3 position, vec3 n, bool centre) {
  vec3 to = l.position - position;
  float h = -dot(to, l.normal), radius = l.radius;
  if (h <= 0.0 || radius <= 0.0) return 0.0;
  float along = dot(n, l.normal), height = dot(n, to);
  float reach = radius * sqrt(max(0.0, 1.0 - along * along));
  if (height + reach <= 0.0) return 0.0;
  vec3 aside = to + l.normal * h;
  float r = length(aside), r2 = radius * radius;
  vec3 w = l.normal, u = r > 0.0 ? aside / r : pnb_frame(w)[0], v = cross(w, u);
  float a = h * h + r * r + r2;
  float s = sqrt((h * h + (r - radius) * (r - radius)) * (h * h + (r + radius) * (r + radius)));
  if (height >= reach || centre) {
    float e = h * h + r * r - r2;
    float facing = e > 0.0 ? 4.0 * h * h * r2 / (s + e) : s - e;
    float axial = 0.5 * pnb_pi * facing / s;
    float radial = 2.0 * pnb_pi * h * r * r2 / ((a + s) * s);
    return max(0.0, radial * dot(n, u) - axial * dot(n, w));
  }
  float nu = dot(n, u), nv = dot(n, v), nw = dot(n, w);
  float middle = sign(nv) * pnb_angle(nu, abs(nv));
  float half_ = pnb_arc_cosine(clamp(-height / reach, -1.0, 1.0));
  float from = middle - half_, till = middle + half_;
  vec3 p0 = u * (r + radius * cos(till)) + v * (radius * sin(till)) - w * h;
  vec3 p1 = u * (r + radius * cos(from)) + v * (radius * sin(from)) - w * h, c = cross(p0, p1);
  float chord = pnb_angle(dot(p0, p1), length(c)) * (dot(c, n) < 0.0 ? -1.0 : 1.0);
  float p = r2 * nw, q = radius * (h * nu + r * nw), t = radius * h * nv, b = 2.0 * r * radius;
  float arc, ds = sin(till) - sin(from), dc = cos(till) - cos(from);
  if (b < 2e-3 * a) {  // to first order in b / a
    float sq = 0.5 * (sin(till) * sin(till) - sin(from) * sin(from));
    float cq = 0.5 * (till - from) + 0.25 * (sin(2.0 * till) - sin(2.0 * from));
    arc = 0.5 / a * (p * (till - from) + q * ds - t * dc - b / a * (p * ds + q * cq + t * sq));
  } else {
    float inner = pnb_disk_angle(a, b, s, till) - pnb_disk_angle(a, b, s, from);
    float log_term = log((a + b * cos(till)) / (a + b * cos(from)));
    arc = 0.5 * (q / b * (till - from) + (p - q * a / b) * inner - t / b * log_term);
  }
  return abs(arc + 0.5 * chord);
}
