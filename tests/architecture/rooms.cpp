#include "architecture/rooms.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace {

/// Which rooms each room may include, itself and the installed headers aside.
const std::map<std::string, std::set<std::string>>& arrows() {
  static const std::map<std::string, std::set<std::string>> rooms = {
      {"include", {}},
      {"base", {}},
      {"gl", {"base"}},
      {"image", {"base"}},
      {"compare", {"base", "image"}},
      {"scene", {"base", "image"}},
      {"sdf", {"base", "scene", "image"}},
      {"geometry", {"base", "image", "scene", "sdf"}},
      {"shadow", {"base", "image", "scene", "sdf", "geometry"}},
      {"render", {"base", "gl", "image", "scene", "sdf", "geometry", "shadow"}},
      {"bake", {"base", "gl", "image", "scene", "sdf", "geometry", "shadow", "render"}},
      {"apps",
       {"base", "gl", "image", "compare", "scene", "sdf", "geometry", "shadow", "render", "bake"}},
  };
  return rooms;
}

std::string first_folder(std::string_view path) {
  const size_t slash = path.find('/');
  return slash == path.npos ? "" : std::string(path.substr(0, slash));
}

std::string_view without_spaces(std::string_view s) {
  const size_t start = s.find_first_not_of(" \t");
  return start == s.npos ? std::string_view() : s.substr(start);
}

struct Include {
  std::string target;
  bool quoted;
};

std::optional<Include> include_of(std::string_view line) {
  line = without_spaces(line);
  if (line.empty() || line[0] != '#') return {};
  line = without_spaces(line.substr(1));
  if (!line.starts_with("include")) return {};
  line = without_spaces(line.substr(7));
  if (line.empty() || (line[0] != '"' && line[0] != '<')) return {};
  const bool quoted = line[0] == '"';
  const size_t end = line.find(quoted ? '"' : '>', 1);
  if (end == line.npos) return {};
  return Include{std::string(line.substr(1, end - 1)), quoted};
}

/// What is wrong with `include` in a file of `room`; empty when nothing is.
std::string objection(const std::string& room, const Include& include) {
  if (include.target.find("..") != include.target.npos) return "climbs out of its folder";
  const std::string other = first_folder(include.target);
  if (other == "penumbra" || other == room) return "";
  const bool is_room = arrows().contains(other);
  if (!include.quoted && !is_room) return "";
  if (other.empty()) return room == "apps" ? "" : "does not name the room";
  if (!is_room) return "names an unknown room";
  return arrows().at(room).contains(other) ? "" : "points against the arrows";
}

}  // namespace

std::string room_of(std::string_view path) {
  std::string first = first_folder(path);
  if (first == "src") return first_folder(path.substr(4));
  return first == "apps" || first == "include" ? first : "";
}

std::vector<Offence> forbidden_includes(std::string_view path, std::string_view text) {
  const std::string room = room_of(path);
  if (room.empty()) return {};
  if (!arrows().contains(room)) return {{std::string(path), 1, "is in an unknown room " + room}};
  std::vector<Offence> offences;
  for (int line = 1; !text.empty(); ++line) {
    const size_t end = std::min(text.find('\n'), text.size());
    if (const auto include = include_of(text.substr(0, end))) {
      const std::string what = objection(room, *include);
      if (!what.empty())
        offences.push_back({std::string(path), line, include->target + " " + what});
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return offences;
}

int line_count(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}
