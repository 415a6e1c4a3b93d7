#include "scene/mesh/ply_header.h"

#include <array>
#include <optional>
#include <utility>

#include "scene/mesh/text_cursor.h"

namespace penumbra {
namespace {

using enum PlyType;

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypes{{{"char", int8},
                                                                       {"uchar", uint8},
                                                                       {"short", int16},
                                                                       {"ushort", uint16},
                                                                       {"int", int32},
                                                                       {"uint", uint32},
                                                                       {"float", float32},
                                                                       {"double", float64},
                                                                       {"int8", int8},
                                                                       {"uint8", uint8},
                                                                       {"int16", int16},
                                                                       {"uint16", uint16},
                                                                       {"int32", int32},
                                                                       {"uint32", uint32},
                                                                       {"float32", float32},
                                                                       {"float64", float64}}};

PlyType parse_type(TextCursor& cursor) {
  cursor.skip_blanks();
  const std::size_t begin = cursor.offset();
  const std::string_view word = cursor.word();
  for (const auto& [name, type] : kTypes)
    if (name == word) return type;
  cursor.fail_at(begin, in_quotes(word) + " is no type of PLY", "use float, int, uchar or another");
}

PlyProperty parse_property(TextCursor& cursor) {
  PlyProperty property;
  TextCursor ahead = cursor;
  if (ahead.word() == "list") {
    cursor = ahead;
    property.is_list = true;
    cursor.skip_blanks();
    const std::size_t begin = cursor.offset();
    property.count_type = parse_type(cursor);
    if (!is_integer(property.count_type))
      cursor.fail_at(begin, "the length of a list cannot be a fraction", "use uchar or int");
  }
  property.type = parse_type(cursor);
  property.name = cursor.word();
  if (property.name.empty()) cursor.fail("the property has no name", "name it");
  return property;
}

PlyElement parse_element(TextCursor& cursor) {
  PlyElement element;
  element.name = cursor.word();
  if (element.name.empty()) cursor.fail("the element has no name", "name it");
  cursor.skip_blanks();
  const std::size_t begin = cursor.offset();
  const std::int64_t count = cursor.integer("count");
  if (count < 0) cursor.fail_at(begin, "an element cannot have a negative count", "correct it");
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

PlyEncoding parse_format(TextCursor& cursor) {
  cursor.skip_blanks();
  const std::size_t begin = cursor.offset();
  const std::string_view word = cursor.word();
  if (word == "ascii") return PlyEncoding::ascii;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  cursor.fail_at(begin, in_quotes(word) + " is no format of PLY",
                 "use ascii, binary_little_endian or binary_big_endian");
}

/// One line of the header; false at end_header.
bool parse_line(TextCursor& cursor, PlyHeader& header, std::optional<PlyEncoding>& encoding) {
  cursor.skip_blanks();
  const std::size_t begin = cursor.offset();
  if (cursor.at_end())
    cursor.fail("the file ends within the PLY header", "check whether the file is complete");
  const std::string_view keyword = cursor.word();
  if (keyword == "end_header") return false;
  if (keyword == "format")
    encoding = parse_format(cursor);
  else if (keyword == "element")
    header.elements.push_back(parse_element(cursor));
  else if (keyword == "property" && header.elements.empty())
    cursor.fail_at(begin, "a property stands before any element", "move it below its element");
  else if (keyword == "property")
    header.elements.back().properties.push_back(parse_property(cursor));
  else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info")
    cursor.fail_at(begin, in_quotes(keyword) + " is no line of a PLY header",
                   "check whether the file is damaged");
  return true;
}

}  // namespace

int byte_size(PlyType type) {
  constexpr int sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

bool is_integer(PlyType type) { return type != float32 && type != float64; }

std::uint64_t PlyElement::least_bytes() const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& p : properties)
    bytes += static_cast<std::uint64_t>(byte_size(p.is_list ? p.count_type : p.type));
  return bytes;
}

PlyHeader parse_ply_header(const std::string& file, std::string_view contents) {
  TextCursor cursor(file, contents);
  if (cursor.word() != "ply" || !cursor.at_line_end())
    cursor.fail_at(0, "this is no PLY file: it does not begin with 'ply'", "check the extension");
  PlyHeader header;
  std::optional<PlyEncoding> encoding;
  do cursor.next_line();
  while (parse_line(cursor, header, encoding));
  if (!encoding) cursor.fail("the PLY header has no format line", "add one, format ascii 1.0 say");
  header.encoding = *encoding;
  cursor.next_line();
  header.size = cursor.offset();
  return header;
}

}  // namespace penumbra
