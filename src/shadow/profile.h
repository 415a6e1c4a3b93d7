// Which visible fraction a clearance stands for.
#pragma once

#include "geometry/cone_tree.h"
#include "shadow/shadows.h"

namespace penumbra {

/// s(τ) for τ in [0, 1] (Parker, Shirley and Smits 1998, section 3); rising from 0 to 1.
float visible_fraction(Profile profile, float tau);

/// What a search for the least clearance may leave out so that the visible fraction changes by at
/// most `tolerance`; never at the outer edge of the penumbra, where a step would show, and never in
/// the dark: a blocked ray always gives 0, or the seams between triangles would show.
SearchLimit search_limit(Profile profile, float tolerance);

}  // namespace penumbra
