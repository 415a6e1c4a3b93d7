// Lights of the command line.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace penumbra::app {

/// A light from a --light SPEC; throws InputError.
///   sphere:px,py,pz,radius,radiance              disk:px,py,pz,nx,ny,nz,radius,radiance
///   rect:corner3,edge_u3,edge_v3,radiance        segment:from3,to3,radius,radiance
///   point:px,py,pz,intensity                     sun:dx,dy,dz,angular_diameter_deg,irradiance
/// The last value is one number, or three for red, green and blue.
Light parse_light(const std::string& spec);

/// Takes out every light; surfaces that were lights stay as they look and light nothing.
void drop_lights(Scene& scene);

/// Scales radii, rect edges (about the centre) and angular diameters; emission per area, or of a
/// sun in all, stays. Returns the warnings: mesh lights keep their size.
std::vector<std::string> scale_lights(Scene& scene, float factor);

}  // namespace penumbra::app
