#include "shadow/profile.h"

#include <penumbra/parker.h>

#include <algorithm>

namespace penumbra {

float visible_fraction(Profile profile, float tau) {
  switch (profile) {
    case Profile::cubic:
      return parker::cubic(tau);
    case Profile::sine:
      return parker::sine(tau);
    case Profile::linear:
      break;
  }
  return parker::linear(tau);
}

SearchLimit search_limit(Profile profile, float tolerance) {
  SearchLimit limit = SearchLimit::exact();
  if (!(tolerance > 0)) return limit;
  // With best answer τ in bin i, anything that would change s by no more than the tolerance may be
  // left out: what lies between s⁻¹(s(τ) − tolerance) and τ, for the largest τ of the bin.
  for (float& fraction : limit.fraction) {
    const float floor = visible_fraction(profile, fraction) - tolerance;
    if (floor <= 0) continue;
    float lo = 0, hi = fraction;
    for (int i = 0; i < 30; ++i) {
      const float middle = (lo + hi) / 2;
      (visible_fraction(profile, middle) < floor ? lo : hi) = middle;
    }
    fraction = hi;
  }
  return limit;
}

}  // namespace penumbra
