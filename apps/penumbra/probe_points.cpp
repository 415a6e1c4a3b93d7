#include "probe_points.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "values.h"

namespace penumbra::app {
namespace {

constexpr std::array<std::string_view, 6> kColumns{"x", "y", "z", "nx", "ny", "nz"};
constexpr double kFarthest = 1e9;  // no scene reaches further
constexpr std::string_view kFraction = "visible_fraction";

std::string_view without_blanks(std::string_view name) {
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  while (!name.empty() && name.back() == ' ') name.remove_suffix(1);
  return name;
}

std::optional<std::size_t> column_of(const CsvRow& header, std::string_view name,
                                     const std::string& file) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (without_blanks(header[i].value) != name) continue;
    if (found)
      throw InputError({file, header[i].line, header[i].column},
                       fmt::format("there are two columns '{}'", name), "rename one of them");
    found = i;
  }
  return found;
}

// Where the values of a point stand in a row.
struct Columns {
  std::array<std::size_t, 6> value{};
  std::optional<std::size_t> light;
};

Columns columns_of(const CsvRow& header, const std::string& file) {
  Columns columns;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    const auto found = column_of(header, kColumns[i], file);
    if (!found)
      throw InputError({file, header[0].line, header[0].column},
                       fmt::format("there is no column '{}'", kColumns[i]),
                       "name x,y,z,nx,ny,nz in the header");
    columns.value[i] = *found;
  }
  columns.light = column_of(header, "light", file);
  return columns;
}

float number(const CsvField& field, const std::string& file) {
  double value = 0;
  if (!read_number(field.value, value) || !std::isfinite(static_cast<float>(value)))
    throw InputError({file, field.line, field.column},
                     fmt::format("'{}' is not a finite number", field.value),
                     "write it like 0.25 or 1e-3");
  if (std::abs(value) > kFarthest)
    throw InputError({file, field.line, field.column},
                     fmt::format("{} is beyond {:g}", field.value, kFarthest),
                     "give points as near to the origin as scenes are");
  return static_cast<float>(value);
}

std::size_t light_of(const CsvField& field, const std::string& file, std::size_t light_count) {
  double value = 0;
  if (!read_number(field.value, value) || value != std::floor(value))
    throw InputError({file, field.line, field.column},
                     fmt::format("'{}' is not the index of a light", field.value),
                     "write a whole number from 0");
  if (!(value >= 0 && value < static_cast<double>(light_count)))
    throw InputError(
        {file, field.line, field.column}, fmt::format("there is no light {}", field.value),
        light_count == 1 ? "the only light of the scene is 0"
                         : fmt::format("the scene's lights are 0 to {}", light_count - 1));
  return static_cast<std::size_t>(value);
}

ProbePoint point_of(const CsvRow& row, const Columns& columns, const std::string& file,
                    std::size_t light_count) {
  std::array<float, 6> value{};
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = number(row[columns.value[i]], file);
  const Vec3d normal(value[3], value[4], value[5]);
  const CsvField& at = row[columns.value[3]];
  if (!(length(normal) > 0))
    throw InputError({file, at.line, at.column}, "the normal is zero",
                     "give the direction that the surface faces");
  return {{{value[0], value[1], value[2]}, Vec3(normalize(normal))},
          columns.light ? light_of(row[*columns.light], file, light_count) : 0};
}

}  // namespace

std::vector<ProbePoint> points_of(const CsvTable& table, const std::string& file,
                                  std::size_t light_count) {
  const Columns columns = columns_of(table.header, file);
  column_of(table.header, kFraction, file);
  if (table.rows.empty()) throw InputError({file}, "there are no points", "add a row for each");
  if (light_count == 0)
    throw InputError("the scene has no light to be seen", "add one with --light");
  std::vector<ProbePoint> points;
  points.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) points.push_back(point_of(row, columns, file, light_count));
  return points;
}

void set_visible_fractions(CsvTable& table, const std::vector<float>& fractions) {
  std::size_t column = 0;
  while (column < table.header.size() && without_blanks(table.header[column].value) != kFraction)
    ++column;
  if (column == table.header.size()) table.header.push_back({std::string(kFraction), {}, 0, 0});
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    table.rows[i].resize(table.header.size());
    table.rows[i][column].raw = fmt::format("{:.6f}", fractions[i]);
  }
}

}  // namespace penumbra::app
