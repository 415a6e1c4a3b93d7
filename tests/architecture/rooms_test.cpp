#include "architecture/rooms.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace fs = std::filesystem;

namespace {

/// Every text file of ours by its path from the top: what the repository would hold, without
/// what is built or rendered.
const std::map<std::string, std::string>& our_files() {
  static const auto files = [] {
    std::map<std::string, std::string> found;
    const fs::path top = PENUMBRA_SOURCE_DIR;
    for (auto it = fs::recursive_directory_iterator(top); it != fs::end(it); ++it) {
      const std::string name = it->path().filename().string();
      const bool at_top = it.depth() == 0;
      if (at_top && (name == "build" || name == "out" || name == ".git" || name == ".cache")) {
        it.disable_recursion_pending();
      } else if (it->is_regular_file()) {
        std::stringstream text;
        text << std::ifstream(it->path(), std::ios::binary).rdbuf();
        found[fs::relative(it->path(), top).generic_string()] = text.str();
      }
    }
    return found;
  }();
  return files;
}

bool is_source(const std::string& path) { return path.ends_with(".h") || path.ends_with(".cpp"); }

/// An absolute path that exists on one person's machine only.
const std::regex& private_path() {
  static const std::regex pattern(
      "(^|[^A-Za-z0-9_.~/}-])/(home|root|Users|work|workspace|mnt|tmp/wt)/[A-Za-z0-9_.]");
  return pattern;
}

std::vector<Offence> private_paths(const std::string& path, const std::string& text) {
  std::vector<Offence> offences;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number)
    if (line.size() < 2000 && std::regex_search(line, private_path()))
      offences.push_back({path, number, line});
  return offences;
}

std::string told(const std::vector<Offence>& offences) {
  std::ostringstream text;
  for (const Offence& o : offences) text << o.file << ':' << o.line << ": " << o.what << '\n';
  return text.str();
}

}  // namespace

TEST(Architecture, IncludesFollowTheArrows) {
  ASSERT_TRUE(our_files().contains("src/base/vec.h"));
  std::vector<Offence> offences;
  for (const auto& [path, text] : our_files())
    if (is_source(path))
      for (const Offence& o : forbidden_includes(path, text)) offences.push_back(o);
  EXPECT_TRUE(offences.empty()) << told(offences);
}

TEST(Architecture, NoSourceFileIsOver500Lines) {
  for (const auto& [path, text] : our_files())
    EXPECT_TRUE(!is_source(path) || line_count(text) <= 500) << path << ' ' << line_count(text);
}

TEST(Architecture, NoFileNamesAPathOfOneMachine) {
  std::vector<Offence> offences;
  for (const auto& [path, text] : our_files())
    if (text.find('\0') == text.npos)
      for (const Offence& o : private_paths(path, text)) offences.push_back(o);
  EXPECT_TRUE(offences.empty()) << told(offences);
}

TEST(ForbiddenIncludes, RefusesWhatPointsAgainstTheArrows) {
  const auto offences =
      forbidden_includes("src/base/a.h", "#pragma once\n# include \"image/b.h\"\n");
  ASSERT_EQ(offences.size(), 1u);
  EXPECT_EQ(offences[0], (Offence{"src/base/a.h", 2, "image/b.h points against the arrows"}));
}

TEST(ForbiddenIncludes, RefusesARoomInAngleBracketsToo) {
  EXPECT_EQ(forbidden_includes("src/shadow/a.cpp", "#include <render/b.h>").size(), 1u);
}

TEST(ForbiddenIncludes, RefusesWhatClimbsOrNamesNoRoom) {
  EXPECT_EQ(forbidden_includes("src/render/a.cpp", "#include \"../shadow/b.h\"\n").size(), 1u);
  EXPECT_EQ(forbidden_includes("src/render/a.cpp", "#include \"b.h\"\n").size(), 1u);
  EXPECT_EQ(forbidden_includes("src/render/a.cpp", "#include \"lights/b.h\"\n").size(), 1u);
}

TEST(ForbiddenIncludes, KeepsTheInstalledHeadersAlone) {
  EXPECT_EQ(forbidden_includes("include/penumbra/a.h", "#include \"base/vec.h\"\n").size(), 1u);
  EXPECT_TRUE(forbidden_includes("include/penumbra/a.h", "#include <cmath>\n").empty());
}

TEST(ForbiddenIncludes, LetsTheArrowsBe) {
  EXPECT_TRUE(forbidden_includes("src/shadow/a.cpp",
                                 "#include <vector>\n#include \"shadow/a.h\"\n"
                                 "#include \"geometry/world.h\"\n#include <penumbra/parker.h>\n")
                  .empty());
  EXPECT_TRUE(forbidden_includes("apps/penumbra/main.cpp", "#include \"render/a.h\"\n").empty());
  EXPECT_TRUE(forbidden_includes("tests/base/a.cpp", "#include \"render/a.h\"\n").empty());
}

TEST(ForbiddenIncludes, RefusesAnUnknownRoom) {
  EXPECT_EQ(forbidden_includes("src/misc/a.h", "").size(), 1u);
}

TEST(PrivatePaths, AreFound) {
  const std::string slash = "/";
  EXPECT_EQ(private_paths("a", "see " + slash + "home/ann/scene.json\n").size(), 1u);
  EXPECT_TRUE(private_paths("a", "see ../shared/scene.json, https://example.org/home/x\n").empty());
}
