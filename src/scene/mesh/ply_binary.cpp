#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

#include "base/error.h"
#include "scene/mesh/ply_layout.h"
#include "scene/mesh/text_cursor.h"

namespace penumbra {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Takes values from the bytes, checked against their end.
class ByteCursor {
 public:
  ByteCursor(const std::string& file, std::string_view bytes, std::size_t at, bool swap)
      : file_(file), bytes_(bytes), at_(at), swap_(swap) {}

  std::size_t left() const { return bytes_.size() - at_; }

  template <class T>
  T take() {
    unsigned char raw[sizeof(T)];
    std::memcpy(raw, advance(sizeof(T)), sizeof(T));
    if (swap_) std::reverse(raw, raw + sizeof(T));
    return std::bit_cast<T>(raw);
  }

  void skip(std::uint64_t count, int size) {
    const std::uint64_t bytes_each = static_cast<std::uint64_t>(size);
    if (count > left() / bytes_each) fail_at_end();
    at_ += count * bytes_each;
  }

  /// Calls visit(value) with a value of that type.
  template <class Visit>
  auto take(PlyType type, const Visit& visit) {
    switch (type) {
      case PlyType::int8:
        return visit(take<std::int8_t>());
      case PlyType::uint8:
        return visit(take<std::uint8_t>());
      case PlyType::int16:
        return visit(take<std::int16_t>());
      case PlyType::uint16:
        return visit(take<std::uint16_t>());
      case PlyType::int32:
        return visit(take<std::int32_t>());
      case PlyType::uint32:
        return visit(take<std::uint32_t>());
      case PlyType::float32:
        return visit(take<float>());
      case PlyType::float64:
        break;
    }
    return visit(take<double>());
  }
  float real(PlyType type) {
    return take(type, [](auto value) { return static_cast<float>(value); });
  }
  /// `type` must be an integer.
  std::int64_t integer(PlyType type) {
    return take(type, [](auto value) {
      if constexpr (std::is_floating_point_v<decltype(value)>)
        return std::int64_t{0};
      else
        return static_cast<std::int64_t>(value);
    });
  }

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError({file_, at_}, what, remedy);
  }

 private:
  const char* advance(std::size_t count) {
    if (count > left()) fail_at_end();
    const char* at = bytes_.data() + at_;
    at_ += count;
    return at;
  }
  [[noreturn]] void fail_at_end() const {
    fail("the file ends before all elements that its header declares",
         "check whether the file is complete");
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_;
  bool swap_;
};

std::uint64_t take_list_length(ByteCursor& cursor, const PlyProperty& list) {
  const std::int64_t length = cursor.integer(list.count_type);
  if (length < 0) cursor.fail("a list has a negative length", "export the model again");
  return static_cast<std::uint64_t>(length);
}

void skip_property(ByteCursor& cursor, const PlyProperty& property) {
  const std::uint64_t count = property.is_list ? take_list_length(cursor, property) : 1;
  cursor.skip(count, byte_size(property.type));
}

void skip_element(ByteCursor& cursor, const PlyElement& element) {
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
    for (const PlyProperty& property : element.properties) skip_property(cursor, property);
}

void read_vertices(ByteCursor& cursor, const PlyElement& element, const PlyLayout& layout,
                   Mesh& mesh) {
  allocate_vertices(layout, element.count, mesh);
  PlyVertex vertex{};
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (layout.attribute[p] < 0)
        skip_property(cursor, element.properties[p]);
      else
        vertex[layout.attribute[p]] = cursor.real(element.properties[p].type);
    }
    store_vertex(layout, vertex, i, mesh);
  }
}

void read_corners(ByteCursor& cursor, const PlyProperty& list, std::uint64_t vertex_count,
                  std::vector<std::uint32_t>& corners) {
  corners.clear();
  for (std::uint64_t n = take_list_length(cursor, list); n > 0; --n) {
    const std::int64_t corner = cursor.integer(list.type);
    if (corner < 0 || static_cast<std::uint64_t>(corner) >= vertex_count)
      cursor.fail(corner_message(corner, vertex_count), "export the model again");
    corners.push_back(static_cast<std::uint32_t>(corner));
  }
}

std::uint64_t read_faces(ByteCursor& cursor, const PlyElement& element, const PlyLayout& layout,
                         Mesh& mesh) {
  PlyFaces faces(mesh);
  faces.indices.reserve(3 * element.count);
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (p == layout.corner_property)
        read_corners(cursor, element.properties[p], mesh.positions.size(), corners);
      else
        skip_property(cursor, element.properties[p]);
    }
    faces.add(corners);
  }
  mesh.indices = std::move(faces.indices);
  return faces.too_small;
}

void check_count(const ByteCursor& cursor, const PlyElement& element) {
  const std::uint64_t least = element.least_bytes();
  if (least > 0 && element.count > cursor.left() / least)
    cursor.fail(fmt::format("the header declares {} elements {}, more than the file has bytes for",
                            element.count, in_quotes(element.name)),
                "check whether the file is complete");
}

}  // namespace

std::uint64_t read_ply_binary(const std::string& file, std::string_view contents,
                              const PlyHeader& header, const PlyLayout& layout, Mesh& mesh) {
  ByteCursor cursor(file, contents, header.size, header.encoding == PlyEncoding::big_endian);
  std::uint64_t too_small = 0;
  std::optional<ByteCursor> faces_before_vertices;
  for (std::size_t e = 0; e < header.elements.size(); ++e) {
    const PlyElement& element = header.elements[e];
    check_count(cursor, element);
    if (e == layout.vertex_element) {
      read_vertices(cursor, element, layout, mesh);
      if (faces_before_vertices)
        too_small =
            read_faces(*faces_before_vertices, header.elements[layout.face_element], layout, mesh);
    } else if (e == layout.face_element && layout.vertex_element < e) {
      too_small = read_faces(cursor, element, layout, mesh);
    } else {
      if (e == layout.face_element) faces_before_vertices.emplace(cursor);
      skip_element(cursor, element);
    }
  }
  return too_small;
}

}  // namespace penumbra
