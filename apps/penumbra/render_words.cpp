#include "render_words.h"

#include <algorithm>
#include <array>

namespace penumbra::app {
namespace {

// Options of compare, or of its call alone, and whether a value follows.
struct Dropped {
  std::string_view name;
  bool has_value;
};
constexpr std::array<Dropped, 11> kDropped{{{"-o", true},
                                            {"--output", true},
                                            {"--shadows", true},
                                            {"--repeats", true},
                                            {"--sweep", true},
                                            {"--stats", true},
                                            {"--aov", true},
                                            {"--variant", true},
                                            {"--time", true},
                                            {"-q", false},
                                            {"--quiet", false}}};

std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789_-+=./,:@%") == word.npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) c == '\'' ? out += "'\\''" : out += c;
  return out + "'";
}

std::string variant_of(const Arguments& a, std::string_view method) {
  const SdfVariant variant = a.render.shadows.variant;
  if (variant == SdfVariant::blog && method == "sdf-classic") return " --variant blog";
  if (variant == SdfVariant::abs && method == "sdf-inner") return " --variant abs";
  if (variant == SdfVariant::march && method == "hard") return " --variant march";
  return "";
}

}  // namespace

std::string all_words(const Arguments& arguments) {
  std::string out = "penumbra";
  for (std::size_t i = 1; i < arguments.command_line.size(); ++i)
    out += ' ' + quoted(arguments.command_line[i]);
  return out;
}

std::string render_words(const Arguments& a, std::string_view method) {
  std::string out = "penumbra render";
  const auto& words = a.command_line;
  const auto compare = std::find(words.begin(), words.end(), "compare");
  for (auto word = compare == words.end() ? words.end() : compare + 1; word != words.end();
       ++word) {
    const std::string name = word->substr(0, word->find('='));
    const auto dropped = std::find_if(kDropped.begin(), kDropped.end(),
                                      [&](const Dropped& d) { return d.name == name; });
    if (dropped == kDropped.end())
      out += ' ' + quoted(*word);
    else if (dropped->has_value && name == *word && word + 1 != words.end())
      ++word;
  }
  out += " --shadows ";
  out += method;
  out += variant_of(a, method) + " -o ";
  out += method;
  return out + ".png";
}

}  // namespace penumbra::app
