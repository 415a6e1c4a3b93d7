#include "film.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "outputs.h"

namespace penumbra::app {
namespace {

struct Container {
  const char *extension, *name;
  std::array<const char*, 4> codec;
};
constexpr std::array<const char*, 4> h264{"-c:v", "libx264", "-crf", "18"};
constexpr Container containers[] = {{".mp4", "mp4", h264},
                                    {".mov", "mov", h264},
                                    {".mkv", "matroska", h264},
                                    {".webm", "webm", {"-c:v", "libvpx-vp9", "-crf", "24"}},
                                    {".gif", "gif", {"-c:v", "gif", "-loop", "0"}}};

const Container* container_of(const std::string& file) {
  for (const Container& c : containers)
    if (has_extension(file, c.extension)) return &c;
  return nullptr;
}

int run(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) return 127;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

bool is_film(const std::string& file) { return container_of(file) != nullptr; }

void check_ffmpeg() {
  const char* path = std::getenv("PATH");
  std::string_view rest = path ? path : "";
  while (!rest.empty()) {
    const std::string folder(rest.substr(0, rest.find(':')));
    if (::access((std::filesystem::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return;
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
  }
  throw InputError("films are made by ffmpeg, and there is none on this machine",
                   "install it, or write frames: -o frames/%04d.png");
}

void make_film(const std::string& pattern, int frames, double frames_per_second,
               const std::string& folder, const std::string& film) {
  const Container& container = *container_of(film);
  const std::string unfinished = (std::filesystem::path(folder) / "film").string();
  std::vector<std::string> words{"ffmpeg",
                                 "-y",
                                 "-nostdin",
                                 "-loglevel",
                                 "error",
                                 "-framerate",
                                 fmt::format("{:.6f}", frames_per_second),
                                 "-start_number",
                                 "0",
                                 "-i",
                                 pattern,
                                 "-frames:v",
                                 std::to_string(frames)};
  words.insert(words.end(), container.codec.begin(), container.codec.end());
  if (std::string_view(container.name) != "gif")
    // Most players ask for even sizes and halved colours.
    for (const char* word : {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"})
      words.emplace_back(word);
  for (const char* word : {"-f", container.name}) words.emplace_back(word);
  words.push_back(unfinished);
  std::error_code error;
  if (const int status = run(words); status != 0) {
    std::filesystem::remove(unfinished, error);
    throw WorkError({film}, fmt::format("ffmpeg ended with {}", status),
                    "see what it says above; the frames are kept");
  }
  std::filesystem::rename(unfinished, film, error);
  if (error)
    throw WorkError({film}, "cannot be written: " + error.message(), "take it from " + unfinished);
}

}  // namespace penumbra::app
