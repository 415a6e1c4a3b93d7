#include <fmt/core.h>

#include <algorithm>
#include <exception>

#include "base/parallel.h"
#include "scene/mesh/ply_layout.h"
#include "scene/mesh/text_cursor.h"

namespace penumbra {
namespace {

/// Some lines of the file; blank ones do not count.
struct Piece {
  std::size_t begin = 0, end = 0;  ///< bytes
  std::uint64_t lines = 0;
  std::uint64_t first_line = 0;  ///< number of its first line, from 0 after the header
};

constexpr std::size_t kPieceBytes = std::size_t{1} << 19;

/// Runs body(i) for all pieces in parallel. Of several errors the first in the file is thrown,
/// whichever came first in time.
template <class Body>
void for_each_piece(std::size_t count, const Body& body) {
  std::vector<std::exception_ptr> errors(count);
  parallel_for(count, [&](std::size_t i) {
    try {
      body(i);
    } catch (const InputError&) {
      errors[i] = std::current_exception();
    }
  });
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);
}

std::vector<Piece> cut(std::string_view contents, std::size_t begin) {
  std::vector<Piece> pieces;
  while (begin < contents.size()) {
    const std::size_t newline = contents.find('\n', begin + kPieceBytes);
    const std::size_t end = newline == std::string_view::npos ? contents.size() : newline + 1;
    pieces.push_back({begin, end});
    begin = end;
  }
  return pieces;
}

class AsciiBody {
 public:
  AsciiBody(const std::string& file, std::string_view contents, const PlyHeader& header,
            const PlyLayout& layout, Mesh& mesh)
      : file_(file),
        contents_(contents),
        header_(header),
        layout_(layout),
        mesh_(mesh),
        pieces_(cut(contents, header.size)) {}

  std::uint64_t read() {
    count_lines();
    check_counts();
    allocate_vertices(layout_, header_.elements[layout_.vertex_element].count, mesh_);
    read_vertices();
    return layout_.face_element < header_.elements.size() ? read_faces() : 0;
  }

 private:
  TextCursor cursor(const Piece& piece) const { return {file_, contents_, piece.begin, piece.end}; }

  void count_lines() {
    for_each_piece(pieces_.size(), [&](std::size_t i) {
      for (TextCursor c = cursor(pieces_[i]); !c.at_end(); c.next_line())
        pieces_[i].lines += !c.at_line_end();
    });
    for (Piece& piece : pieces_) {
      piece.first_line = lines_;
      lines_ += piece.lines;
    }
  }

  /// One element a line, as the format has it; their numbers are known before memory is taken.
  void check_counts() const {
    std::uint64_t left = lines_;
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.count > left)
        throw InputError(
            place_in_text(file_, contents_, contents_.size()),
            fmt::format("the header declares {} elements {}, and only {} lines are left for them",
                        element.count, in_quotes(element.name), left),
            "check whether the file is complete");
      left -= element.count;
    }
  }

  std::uint64_t first_line_of(std::size_t element) const {
    std::uint64_t line = 0;
    for (std::size_t e = 0; e < element; ++e)
      if (!header_.elements[e].properties.empty()) line += header_.elements[e].count;
    return line;
  }

  /// Calls body(piece number, cursor, number of the element) for every line of that element.
  template <class Body>
  void for_each_line_of(std::size_t element, const Body& body) const {
    const std::uint64_t begin = first_line_of(element);
    const std::uint64_t end = begin + header_.elements[element].count;
    for_each_piece(pieces_.size(), [&](std::size_t i) {
      std::uint64_t line = pieces_[i].first_line;
      if (line >= end || line + pieces_[i].lines <= begin) return;
      for (TextCursor c = cursor(pieces_[i]); !c.at_end() && line < end; c.next_line()) {
        if (c.at_line_end()) continue;
        if (line >= begin) body(i, c, line - begin);
        ++line;
      }
    });
  }

  void read_vertices() {
    const auto& properties = header_.elements[layout_.vertex_element].properties;
    for_each_line_of(layout_.vertex_element, [&](std::size_t, TextCursor& c, std::uint64_t index) {
      PlyVertex vertex{};
      for (std::size_t p = 0; p < properties.size(); ++p) {
        if (layout_.attribute[p] < 0)
          skip_property(c, properties[p]);
        else
          vertex[layout_.attribute[p]] = c.number(properties[p].name.c_str());
      }
      store_vertex(layout_, vertex, index, mesh_);
    });
  }

  std::uint64_t read_faces() {
    const auto& properties = header_.elements[layout_.face_element].properties;
    std::vector<PlyFaces> faces(pieces_.size(), PlyFaces(mesh_));
    std::vector<std::vector<std::uint32_t>> corners(pieces_.size());
    for_each_line_of(layout_.face_element, [&](std::size_t i, TextCursor& c, std::uint64_t) {
      for (std::size_t p = 0; p < properties.size(); ++p) {
        if (p == layout_.corner_property)
          read_corners(c, corners[i]);
        else
          skip_property(c, properties[p]);
      }
      faces[i].add(corners[i]);
    });
    return join(faces);
  }

  void read_corners(TextCursor& c, std::vector<std::uint32_t>& corners) const {
    corners.clear();
    for (std::int64_t n = list_length(c); n > 0; --n) {
      c.skip_blanks();
      const std::size_t begin = c.offset();
      const std::int64_t corner = c.integer("vertex index");
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= mesh_.positions.size())
        c.fail_at(begin, corner_message(corner, mesh_.positions.size()), "export the model again");
      corners.push_back(static_cast<std::uint32_t>(corner));
    }
  }

  static std::int64_t list_length(TextCursor& c) {
    c.skip_blanks();
    const std::size_t begin = c.offset();
    const std::int64_t length = c.integer("length of a list");
    if (length < 0) c.fail_at(begin, "a list has a negative length", "export the model again");
    return length;
  }

  static void skip_property(TextCursor& c, const PlyProperty& property) {
    for (std::int64_t n = property.is_list ? list_length(c) : 1; n > 0; --n)
      if (c.word().empty()) c.number(property.name.c_str());  // says what is missing
  }

  std::uint64_t join(const std::vector<PlyFaces>& faces) {
    std::size_t total = 0;
    std::uint64_t too_small = 0;
    for (const PlyFaces& f : faces) total += f.indices.size(), too_small += f.too_small;
    mesh_.indices.reserve(total);
    for (const PlyFaces& f : faces)
      mesh_.indices.insert(mesh_.indices.end(), f.indices.begin(), f.indices.end());
    return too_small;
  }

  const std::string& file_;
  std::string_view contents_;
  const PlyHeader& header_;
  const PlyLayout& layout_;
  Mesh& mesh_;
  std::vector<Piece> pieces_;
  std::uint64_t lines_ = 0;  ///< after the header
};

}  // namespace

std::uint64_t read_ply_ascii(const std::string& file, std::string_view contents,
                             const PlyHeader& header, const PlyLayout& layout, Mesh& mesh) {
  return AsciiBody(file, contents, header, layout, mesh).read();
}

}  // namespace penumbra
