
// What a ray meets.
struct pnb_Met {
  float t;
  vec3 position, normal;  // shading point and normal, towards the viewer
  vec3 facing;            // geometric normal, towards the viewer
  pnb_Material material;
};

// At pnb_trace's t; `way`: of all rays before it; `width`: of the pixel's beam there.
pnb_Met pnb_met(vec3 ro, vec3 rd, float t, float way, float width) {
  pnb_Met met;
  vec3 p = ro + rd * t;
  float reach = way + t + max(abs(p.x), max(abs(p.y), abs(p.z)));
#ifdef PNB_MESHES
  float nearest = 2.0 * abs(pnb_last) + 1e-6 * reach;
  pnb_Facet f = pnb_facet(p, rd, nearest);
  bool is_facet = f.record >= 0 && nearest <= abs(pnb_shapes(p)) + 1e-6 * reach;
#endif
  vec3 n = pnb_normal(p, rd, 3e-5 * reach);
  // Down to the surface along the ray: the field is flat over so short a way.
  float facing = -dot(n, rd);
  met.t = abs(facing) > 0.05 ? t + pnb_last / abs(facing) : t;
  met.position = ro + rd * met.t;
  met.normal = met.facing = facing < 0.0 ? -n : n;
  met.material = pnb_material(met.position);
#ifdef PNB_MESHES
  if (is_facet) {
    bool front = dot(f.normal, rd) < 0.0;
    met.t = dot(f.position - ro, rd);
    met.position = front ? f.lifted : f.sunk;
    met.facing = front ? f.normal : -f.normal;
    met.normal = front ? f.smooth_normal : -f.smooth_normal;
    met.material = pnb_facet_material(f, front, width / sqrt(max(abs(dot(f.normal, rd)), 0.01)));
  }
#endif
  return met;
}

// Where the shading normal would send it into the surface, it is turned back out.
vec3 pnb_mirrored(vec3 rd, vec3 n, vec3 facing) {
  vec3 r = reflect(rd, n);
  float out_ = dot(r, facing);
  return normalize(out_ > 0.0 ? r : r - facing * (2.001 * out_));
}
