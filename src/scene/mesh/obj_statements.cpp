#include "scene/mesh/obj_statements.h"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_map>

#include "scene/mesh/text_cursor.h"

namespace penumbra {
namespace {

constexpr const char* kAttributeNames[] = {"vertex", "texture coordinate", "normal"};

/// Numbers names in order of first appearance.
class Names {
 public:
  explicit Names(std::vector<std::string>& names) : names_(names) {}
  std::uint32_t number(const std::string& name) {
    const auto [known, is_new] = numbers_.emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    return known->second;
  }

 private:
  std::vector<std::string>& names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

class ObjReader {
 public:
  ObjReader(const std::string& file, std::string_view text)
      : cursor_(file, text), objects_(out_.objects), materials_(out_.materials) {}

  ObjStatements read() {
    for (; !cursor_.at_end(); cursor_.next_line()) {
      cursor_.skip_blanks();
      const std::size_t begin = cursor_.offset();
      statement(begin, cursor_.word());
    }
    check_ranges();
    if (unknown_ > 0)
      out_.warnings.push_back(fmt::format("{} lines are not understood, first {} in line {}",
                                          unknown_, first_unknown_, first_unknown_line_));
    if (curves_ > 0)
      out_.warnings.push_back(fmt::format(
          "{} lines, points, curves or surfaces were left out: only faces are rendered", curves_));
    return std::move(out_);
  }

 private:
  void statement(std::size_t begin, std::string_view keyword) {
    if (keyword.empty() || keyword.starts_with('#')) return;
    if (keyword == "v") return position();
    if (keyword == "vt") return texcoord();
    if (keyword == "vn") return normal();
    if (keyword == "f") return face(begin);
    if (keyword == "usemtl") return set_name(material_);
    if (keyword == "mtllib") return out_.libraries.emplace_back(cursor_.rest_of_line()), void();
    if (keyword == "o") return group_name_.clear(), set_name(object_name_);
    if (keyword == "g") return set_name(group_name_);
    if (is_curve(keyword))
      ++curves_;
    else if (!is_harmless(keyword))
      note_unknown(begin, keyword);
  }

  static bool is_one_of(std::string_view word, std::initializer_list<std::string_view> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
  }
  static bool is_curve(std::string_view word) {
    return is_one_of(word, {"l", "p", "curv", "curv2", "surf"});
  }
  /// Attributes of the display, of curves, or of extensions that change no face.
  static bool is_harmless(std::string_view word) {
    return is_one_of(word, {"s",        "vp",     "vc",         "vw",        "cstype", "deg",
                            "bmat",     "step",   "parm",       "trim",      "hole",   "scrv",
                            "sp",       "end",    "con",        "mg",        "bevel",  "c_interp",
                            "d_interp", "lod",    "shadow_obj", "trace_obj", "ctech",  "stech",
                            "usemap",   "maplib", "call",       "csh",       "t"});
  }

  void note_unknown(std::size_t begin, std::string_view keyword) {
    if (unknown_++ > 0) return;
    first_unknown_ = in_quotes(keyword);
    first_unknown_line_ = cursor_.place(begin).line_or_byte.value();
  }

  void set_name(std::string& name) {
    name = cursor_.rest_of_line();
    group_is_current_ = false;
  }

  void position() {
    const float x = cursor_.number("x"), y = cursor_.number("y");
    out_.positions.emplace_back(x, y, cursor_.number("z"));  // w and colours may follow
  }
  void normal() {
    const float x = cursor_.number("x"), y = cursor_.number("y");
    out_.normals.emplace_back(x, y, cursor_.number("z"));
  }
  void texcoord() {
    const float u = cursor_.number("u");
    out_.texcoords.push_back({u, cursor_.at_line_end() ? 0 : cursor_.number("v")});
  }

  void face(std::size_t begin) {
    const std::size_t first = out_.corners.size();
    while (!cursor_.at_line_end() && !at_comment()) corner();
    const std::size_t count = out_.corners.size() - first;
    if (count < 3)
      cursor_.fail_at(begin, fmt::format("a face has {} corners", count), "give it three or more");
    out_.faces.push_back({first, static_cast<std::uint32_t>(count), current_group()});
    face_offsets_.push_back(begin);
  }

  bool at_comment() {
    TextCursor ahead = cursor_;
    return ahead.take('#');
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void corner() {
    ObjCorner corner{reference(0, out_.positions.size()), kNoAttribute, kNoAttribute};
    if (cursor_.take('/')) {
      TextCursor ahead = cursor_;
      if (!ahead.take('/') && !ahead.at_word_end()) corner[1] = reference(1, out_.texcoords.size());
      if (cursor_.take('/') && !cursor_.at_word_end())
        corner[2] = reference(2, out_.normals.size());
    }
    if (!cursor_.at_word_end())
      cursor_.fail("the corner of a face is not written v/vt/vn", "correct it");
    out_.corners.push_back(corner);
  }

  /// Positive numbers count from 1, negative ones back from the last so far.
  std::uint32_t reference(int attribute, std::size_t so_far) {
    const std::size_t begin = cursor_.offset();
    const std::int64_t number = cursor_.leading_integer(kAttributeNames[attribute]);
    const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(so_far) + number;
    if (number == 0)
      cursor_.fail_at(begin, "a face names number 0, and numbers begin with 1", "correct it");
    if (index < 0 || index >= kNoAttribute) fail_range(begin, attribute, number, so_far);
    return static_cast<std::uint32_t>(index);
  }

  [[noreturn]] void fail_range(std::size_t offset, int attribute, std::int64_t number,
                               std::size_t count) {
    cursor_.fail_at(offset,
                    fmt::format("a face names {} {}, and there are {}", kAttributeNames[attribute],
                                number, count),
                    "export the model again");
  }

  /// Only at the end: a face may name vertices that follow it.
  void check_ranges() {
    const std::array counts{out_.positions.size(), out_.texcoords.size(), out_.normals.size()};
    for (std::size_t f = 0; f < out_.faces.size(); ++f)
      for (std::uint32_t c = 0; c < out_.faces[f].corner_count; ++c)
        for (int a = 0; a < 3; ++a) {
          const std::uint32_t index = out_.corners[out_.faces[f].first_corner + c][a];
          if (index != kNoAttribute && index >= counts[a])
            fail_range(face_offsets_[f], a, std::int64_t{index} + 1, counts[a]);
        }
  }

  std::uint32_t current_group() {
    if (group_is_current_) return group_;
    const std::string& name = group_name_.empty() ? object_name_ : group_name_;
    const bool both = !group_name_.empty() && !object_name_.empty();
    const std::uint32_t object = objects_.number(both ? object_name_ + "/" + group_name_ : name);
    const std::uint32_t material = materials_.number(material_);
    const std::uint64_t key = std::uint64_t{object} << 32 | material;
    const auto [known, is_new] =
        groups_.emplace(key, static_cast<std::uint32_t>(out_.groups.size()));
    if (is_new) out_.groups.push_back({object, material});
    group_is_current_ = true;
    return group_ = known->second;
  }

  TextCursor cursor_;
  ObjStatements out_;
  Names objects_, materials_;
  std::unordered_map<std::uint64_t, std::uint32_t> groups_;
  std::vector<std::size_t> face_offsets_;
  std::string object_name_, group_name_, material_;
  bool group_is_current_ = false;
  std::uint32_t group_ = 0;
  std::uint64_t unknown_ = 0, curves_ = 0, first_unknown_line_ = 0;
  std::string first_unknown_;
};

}  // namespace

ObjStatements read_obj_statements(const std::string& file, std::string_view text) {
  return ObjReader(file, text).read();
}

}  // namespace penumbra
