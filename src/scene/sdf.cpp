#include "scene/sdf.h"

namespace penumbra {
namespace {

using Rule = SdfRule;

constexpr SdfParameter center{"center", 3, Rule::any, false};
constexpr SdfParameter radius{"radius", 1, Rule::positive};
constexpr SdfParameter rounding{"radius", 1, Rule::non_negative};
constexpr SdfParameter half_size{"half_size", 3, Rule::positive};
constexpr SdfParameter half_height{"half_height", 1, Rule::positive};
constexpr SdfParameter major{"major_radius", 1, Rule::positive};
constexpr SdfParameter minor{"minor_radius", 1, Rule::positive};
constexpr SdfParameter blend{"k", 1, Rule::non_negative};

constexpr SdfParameter sphere[] = {center, radius};
constexpr SdfParameter box[] = {center, half_size};
constexpr SdfParameter round_box[] = {center, half_size, rounding};
constexpr SdfParameter ellipsoid[] = {center, {"radii", 3, Rule::positive}};
constexpr SdfParameter torus[] = {center, major, minor};
constexpr SdfParameter capped_torus[] = {
    center, {"aperture_deg", 1, Rule::aperture_deg}, major, minor};
constexpr SdfParameter capsule[] = {{"from", 3, Rule::any}, {"to", 3, Rule::any}, radius};
constexpr SdfParameter cylinder[] = {center, half_height, radius};
constexpr SdfParameter capped_cone[] = {center,
                                        half_height,
                                        {"radius_bottom", 1, Rule::non_negative},
                                        {"radius_top", 1, Rule::non_negative}};
constexpr SdfParameter cone[] = {{"apex", 3, Rule::any, false},
                                 {"angle_deg", 1, Rule::acute_deg},
                                 {"height", 1, Rule::positive}};
constexpr SdfParameter plane[] = {{"normal", 3, Rule::direction}, {"offset", 1, Rule::any, false}};
constexpr SdfParameter hexagonal_prism[] = {center, radius, half_height};
constexpr SdfParameter link[] = {center, {"half_length", 1, Rule::non_negative}, major, minor};
constexpr SdfParameter extrusion[] = {center, half_height};
constexpr SdfParameter revolution[] = {center, {"offset", 1, Rule::non_negative, false}};
constexpr SdfParameter smooth[] = {blend};
constexpr SdfParameter onion[] = {{"thickness", 1, Rule::non_negative}};
constexpr SdfParameter round[] = {rounding};
constexpr SdfParameter displace[] = {{"amplitude", 1, Rule::any},
                                     {"frequency", 3, Rule::any, true, 0, true}};
constexpr SdfParameter translate[] = {{"offset", 3, Rule::any}};
constexpr SdfParameter rotate[] = {{"rotate_deg", 3, Rule::angle_deg}};
constexpr SdfParameter scale[] = {{"factor", 3, Rule::nonzero, true, 0, true}};
constexpr SdfParameter mirror[] = {{"axes", 3, Rule::axes}};
constexpr SdfParameter repeat[] = {{"spacing", 3, Rule::non_negative},
                                   {"limit", 3, Rule::whole, false, -1}};
constexpr SdfParameter rate[] = {{"rate", 1, Rule::any}};
constexpr SdfParameter elongate[] = {{"half_size", 3, Rule::non_negative}};

constexpr auto shape = SdfKind::shape;
constexpr auto operation = SdfKind::operation;
constexpr auto transform = SdfKind::transform;
constexpr int any = sdf_any_number;

constexpr SdfSignature signatures[sdf_op_count] = {
    {SdfOp::sphere, "sphere", shape, sphere, 0, false, "a ball"},
    {SdfOp::box, "box", shape, box, 0, false, "`min` and `max` may stand for center and half_size"},
    {SdfOp::round_box, "round_box", shape, round_box, 0, false,
     "half_size is the outer one; radius is at most its least"},
    {SdfOp::ellipsoid, "ellipsoid", shape, ellipsoid, 0, false,
     "not exact: a bound of the distance"},
    {SdfOp::torus, "torus", shape, torus, 0, false, "about the y axis"},
    {SdfOp::capped_torus, "capped_torus", shape, capped_torus, 0, false,
     "an arc about the z axis, aperture_deg to either side of +y"},
    {SdfOp::capsule, "capsule", shape, capsule, 0, false, "a segment with round ends"},
    {SdfOp::cylinder, "cylinder", shape, cylinder, 0, false, "about the y axis"},
    {SdfOp::capped_cone, "capped_cone", shape, capped_cone, 0, false, "about the y axis"},
    {SdfOp::cone, "cone", shape, cone, 0, false,
     "opens towards −y; angle_deg from its axis to its side"},
    {SdfOp::plane, "plane", shape, plane, 0, false,
     "all points with normal · p ≤ offset; a `point` of the plane may stand for the offset"},
    {SdfOp::hexagonal_prism, "hexagonal_prism", shape, hexagonal_prism, 0, false,
     "along the z axis; radius of the circle inside"},
    {SdfOp::octahedron, "octahedron", shape, sphere, 0, false, "radius: centre to corner"},
    {SdfOp::link, "link", shape, link, 0, false, "a torus about z, drawn apart along y"},
    {SdfOp::extrusion, "extrusion", shape, extrusion, 0, true, "of a `profile` along the z axis"},
    {SdfOp::revolution, "revolution", shape, revolution, 0, true,
     "of a `profile`, `offset` away from the y axis, about it"},
    {SdfOp::union_, "union", operation, {}, any, false, "min(a, b)"},
    {SdfOp::intersection, "intersection", operation, {}, any, false, "max(a, b)"},
    {SdfOp::difference, "difference", operation, {}, any, false, "the first without the others"},
    {SdfOp::smooth_union, "smooth_union", operation, smooth, any, false,
     "min(a, b) − max(k − |a − b|, 0)² / 4k; colours blend"},
    {SdfOp::smooth_intersection, "smooth_intersection", operation, smooth, any, false,
     "max(a, b) + max(k − |a − b|, 0)² / 4k"},
    {SdfOp::smooth_difference, "smooth_difference", operation, smooth, any, false,
     "the first, smoothly without the others"},
    {SdfOp::onion, "onion", operation, onion, 1, false, "|d| − thickness: a shell"},
    {SdfOp::round, "round", operation, round, 1, false, "d − radius"},
    {SdfOp::displace, "displace", operation, displace, 1, false,
     "d + amplitude · sin(fx x) sin(fy y) sin(fz z), frequency a number or [fx, fy, fz] in rad/m"},
    {SdfOp::translate, "translate", transform, translate, 1, false, "moves"},
    {SdfOp::rotate, "rotate", transform, rotate, 1, false,
     "turns about x, then y, then z, as a mesh's transform"},
    {SdfOp::scale, "scale", transform, scale, 1, false,
     "factor a number or [x, y, z]; negative mirrors"},
    {SdfOp::mirror, "mirror", transform, mirror, 1, false,
     "what is at positive x appears at negative x too; axes \"x\", \"xy\", \"xyz\" …"},
    {SdfOp::repeat, "repeat", transform, repeat, 1, false,
     "one copy every `spacing` metres, 0 = not along this axis; `limit` copies to either side"},
    {SdfOp::twist, "twist", transform, rate, 1, false, "rate in rad/m, about the y axis"},
    {SdfOp::bend, "bend", transform, rate, 1, false,
     "rate in rad/m: turns about z by rate · x (Quilez's cheap bend)"},
    {SdfOp::elongate, "elongate", transform, elongate, 1, false,
     "cut at the middle and drawn apart by half_size to either side"},
};

}  // namespace

std::span<const SdfSignature, sdf_op_count> sdf_signatures() { return signatures; }

std::span<const double> SdfTree::parameter(const SdfNode& node, int index) const {
  const auto parameters = signature_of(node.op).parameters;
  std::size_t first = 0;
  for (int i = 0; i < index; ++i) first += static_cast<std::size_t>(parameters[i].count);
  return numbers_of(node).subspan(first, static_cast<std::size_t>(parameters[index].count));
}

std::span<const double> SdfTree::profile_numbers(const SdfNode& node) const {
  std::size_t first = 0;
  for (const SdfParameter& p : signature_of(node.op).parameters)
    first += static_cast<std::size_t>(p.count);
  return numbers_of(node).subspan(first);
}

}  // namespace penumbra
