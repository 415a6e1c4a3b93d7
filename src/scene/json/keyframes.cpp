#include "scene/json/keyframes.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "scene/json/kinds.h"

namespace penumbra::json {
namespace {

constexpr double latest = 1e9;

/// One number's keyframe.
struct Key {
  double time, value;
};

// The slope at b, between two neighbours (Fritsch and Butland 1984, equation 2).
double slope_at(const Key& a, const Key& b, const Key& c) {
  const double before = b.time - a.time, after = c.time - b.time;
  const double d0 = (b.value - a.value) / before, d1 = (c.value - b.value) / after;
  if (d0 * d1 <= 0) return 0;
  return 3 * (before + after) / ((2 * after + before) / d0 + (after + 2 * before) / d1);
}

// Between keys[i] and keys[i + 1].
double smooth(std::span<const Key> keys, std::size_t i, double s) {
  const Key &a = keys[i], &b = keys[i + 1];
  const double way = b.time - a.time;
  const double m0 = i > 0 ? slope_at(keys[i - 1], a, b) * way : 0;
  const double m1 = i + 2 < keys.size() ? slope_at(a, b, keys[i + 2]) * way : 0;
  const double r = 1 - s;
  const double x =
      r * r * ((1 + 2 * s) * a.value + s * m0) + s * s * ((3 - 2 * s) * b.value - r * m1);
  return std::clamp(x, std::min(a.value, b.value), std::max(a.value, b.value));
}

/// A value of one key at one time.
struct Frame {
  double time;
  const Json::Value* value;
};

/// The keyframes of one key, and where among them the moment is.
struct Track {
  const Document& document;
  std::string key;
  std::vector<Frame> frames;
  bool smoothly;
  double time;

  /// Of the last frame that is not after the moment; the first if there is none.
  std::size_t current() const {
    const auto after = std::ranges::upper_bound(frames, time, {}, &Frame::time);
    return after == frames.begin() ? 0 : static_cast<std::size_t>(after - frames.begin()) - 1;
  }
  [[noreturn]] void refuse(const Frame& frame, const std::string& what,
                           const std::string& remedy) const {
    throw InputError(document.place(*frame.value),
                     fmt::format("\"{}\" of a keyframe {}", key, what), remedy);
  }
  /// The same of a part of the values.
  template <class Part>
  Track of(Part part) const {
    Track t{document, key, frames, smoothly, time};
    for (Frame& frame : t.frames) frame.value = part(frame);
    return t;
  }
};

void set(Json::Value& value, const Track& track);

void set_number(Json::Value& value, const Track& track) {
  std::vector<Key> keys;
  keys.reserve(track.frames.size());
  for (const Frame& f : track.frames)
    keys.push_back({f.time, number({track.document, *f.value, track.key},
                                   {-1e12, 1e12, "a number, as the key itself has"})});
  const std::size_t i = track.current();
  double x = keys[i].value;
  if (i + 1 < keys.size() && track.time > keys[i].time) {
    const double s = (track.time - keys[i].time) / (keys[i + 1].time - keys[i].time);
    x = track.smoothly ? smooth(keys, i, s) : (1 - s) * keys[i].value + s * keys[i + 1].value;
  }
  value = *track.frames[i].value;
  Json::Value moved(x);
  value.swapPayload(moved);
}

void set_array(Json::Value& value, const Track& track) {
  for (const Frame& f : track.frames)
    if (!f.value->isArray() || f.value->size() != value.size())
      track.refuse(f,
                   f.value->isArray() ? fmt::format("has {} entries", f.value->size())
                                      : fmt::format("is {}", type_name(*f.value)),
                   fmt::format("give {} entries, as the key itself has", value.size()));
  for (Json::ArrayIndex i = 0; i < value.size(); ++i)
    set(value[i], track.of([i](const Frame& f) { return &(*f.value)[i]; }));
}

/// The tracks of all keys that `frames`, objects, have beside `time`.
std::vector<Track> tracks_of(const Json::Value& thing, std::string_view noun, const Track& all) {
  std::vector<Track> tracks;
  for (const Frame& f : all.frames)
    for (const Member& member : members_in_file_order(*f.value)) {
      if (!thing.isMember(member.key))
        throw InputError(all.document.key_place(*f.value, *member.value),
                         fmt::format("a keyframe moves \"{}\", which {} does not have",
                                     member.key.substr(0, 80), noun),
                         "give it there too, or correct the name");
      auto track = std::ranges::find(tracks, member.key, &Track::key);
      if (track == tracks.end()) {
        tracks.push_back({all.document, member.key, {}, all.smoothly, all.time});
        track = tracks.end() - 1;
      }
      track->frames.push_back({f.time, member.value});
    }
  return tracks;
}

void set_object(Json::Value& value, const Track& track) {
  for (const Frame& f : track.frames)
    if (!f.value->isObject())
      track.refuse(f, fmt::format("is {}", type_name(*f.value)), "give an object { }");
  for (const Track& part : tracks_of(value, fmt::format("\"{}\"", track.key), track))
    set(value[part.key], part);
}

void set(Json::Value& value, const Track& track) {
  if (value.isNumeric()) return set_number(value, track);
  if (value.isArray()) return set_array(value, track);
  if (value.isObject()) return set_object(value, track);
  track.refuse(track.frames.front(), fmt::format("cannot move: it is {}", type_name(value)),
               "move numbers, and arrays and objects of numbers");
}

class Mover {
 public:
  Mover(const Document& document, double time) : document_(document), time_(time) {}

  void move_scene(Json::Value& root) {
    if (!root.isObject()) return;
    if (Json::Value* camera = member(root, "camera")) move(*camera, "the camera");
    if (Json::Value* cameras = member(root, "cameras")) move_each(*cameras, "the camera");
    if (Json::Value* lights = member(root, "lights")) move_each(*lights, "the light");
    if (Json::Value* objects = member(root, "objects")) move_each(*objects, "the object");
  }
  std::vector<double> take_times() { return std::move(times_); }

 private:
  static Json::Value* member(Json::Value& object, const char* key) {
    return object.isMember(key) ? &object[key] : nullptr;
  }
  void move_each(Json::Value& list, std::string_view noun) {
    if (list.isArray() || list.isObject())
      for (Json::Value& thing : list) move(thing, noun);
  }

  void move(Json::Value& thing, std::string_view noun) {
    if (!thing.isObject()) return;
    if (Json::Value* root = member(thing, "root")) move(*root, "the node");
    if (Json::Value* child = member(thing, "child")) move(*child, "the node");
    if (Json::Value* children = member(thing, "children")) move_each(*children, "the node");
    if (!thing.isMember("keyframes") && !thing.isMember("interpolation")) return;
    const bool smoothly = is_smooth(thing, noun);
    const Json::Value list = thing["keyframes"];
    thing.removeMember("keyframes");
    thing.removeMember("interpolation");
    std::vector<Json::Value> poses;
    const Track all = frames_of(list, noun, smoothly, poses);
    for (const Track& track : tracks_of(thing, noun, all)) set(thing[track.key], track);
  }

  bool is_smooth(const Json::Value& thing, std::string_view noun) const {
    if (!thing.isMember("keyframes"))
      throw InputError(document_.place(thing["interpolation"]),
                       fmt::format("{} has an \"interpolation\" and no keyframes", noun),
                       "give \"keyframes\" or leave it out");
    if (!thing.isMember("interpolation")) return false;
    const Json::Value& value = thing["interpolation"];
    const std::string name = text({document_, value, "interpolation"});
    if (name != "linear" && name != "smooth")
      throw InputError(document_.place(value),
                       fmt::format("unknown interpolation \"{}\"", name.substr(0, 80)),
                       suggest(name, {"linear", "smooth"}, List::yes));
    return name == "smooth";
  }

  // poses: the keyframes without their times, which the result refers to.
  Track frames_of(const Json::Value& list, std::string_view noun, bool smoothly,
                  std::vector<Json::Value>& poses) {
    array({document_, list, "keyframes"});
    if (list.empty())
      throw InputError(document_.place(list), fmt::format("the keyframes of {} are none", noun),
                       "give at least one, or leave \"keyframes\" out");
    Track all{document_, "keyframes", {}, smoothly, time_};
    poses.reserve(list.size());
    for (const Json::Value& frame : list) {
      const double time = time_of(frame);
      if (!all.frames.empty() && !(time > all.frames.back().time))
        throw InputError(document_.place(frame["time"]),
                         fmt::format("the keyframe at {:g} s follows one at {:g} s", time,
                                     all.frames.back().time),
                         "put keyframes in the order of their times, each once");
      poses.push_back(frame);
      poses.back().removeMember("time");
      all.frames.push_back({time, &poses.back()});
      times_.push_back(time);
    }
    return all;
  }

  double time_of(const Json::Value& frame) const {
    if (!frame.isObject())
      throw InputError(document_.place(frame), fmt::format("a keyframe is {}", type_name(frame)),
                       "give an object { } with a \"time\"");
    if (!frame.isMember("time"))
      throw InputError(document_.place(frame), "missing key \"time\" in a keyframe",
                       "add it, in seconds");
    return number({document_, frame["time"], "time"}, {-latest, latest, "seconds, at most 1e9"});
  }

  const Document& document_;
  double time_;
  std::vector<double> times_;
};

}  // namespace

void know_keyframes(ObjectReader& reader) {
  for (const char* key : {"keyframes", "interpolation"}) reader.find(key);
}

std::optional<Moment> moment_of(const Document& document, double time) {
  const std::string_view text = document.text_of(document.root());
  const auto holds = [&](std::string_view key) { return text.find(key) != std::string_view::npos; };
  if (!holds("\"keyframes\"") && !holds("\"interpolation\"")) return {};
  Moment moment{document.root(), {}};
  Mover mover(document, time);
  mover.move_scene(moment.root);
  moment.times = mover.take_times();
  return moment;
}

}  // namespace penumbra::json
