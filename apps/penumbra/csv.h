// Comma-separated values as RFC 4180 has them, with places for errors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace penumbra::app {

struct CsvField {
  std::string raw;                     ///< as it stands in the file, quotes included
  std::string value;                   ///< what it means
  std::uint64_t line = 0, column = 0;  ///< where it begins, from 1; columns in bytes
};
using CsvRow = std::vector<CsvField>;

struct CsvTable {
  CsvRow header;
  std::vector<CsvRow> rows;     ///< each as long as the header; blank lines are left out
  std::string line_end = "\n";  ///< of the header: "\n" or "\r\n"
};

/// Parses text; `file` is for the errors (InputError): no header, a row of another length, a quote
/// that is not closed or stands in the middle of a field.
CsvTable parse_csv(const std::string& text, const std::string& file);

std::string to_text(const CsvTable& table);

}  // namespace penumbra::app
