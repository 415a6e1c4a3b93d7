// The points of `probe`, from and to a table.
#pragma once

#include <vector>

#include "csv.h"
#include "shadow/shadows.h"

namespace penumbra::app {

struct ProbePoint {
  Receiver receiver;
  std::size_t light = 0;
};

/// The points of columns x,y,z,nx,ny,nz and light, in order. Throws InputError with the place: a
/// column is missing or there twice, a value is no number, a normal zero, a light not in the scene,
/// there are no rows.
std::vector<ProbePoint> points_of(const CsvTable& table, const std::string& file,
                                  std::size_t light_count);

/// Sets the column visible_fraction, adding it if it is not there; one value a row.
void set_visible_fractions(CsvTable& table, const std::vector<float>& fractions);

}  // namespace penumbra::app
