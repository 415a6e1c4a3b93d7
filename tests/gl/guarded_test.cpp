#include "gl/guarded.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "base/cancel.h"
#include "base/error.h"

namespace penumbra::gl {
namespace {

class Recorder : public Progress {
 public:
  void start(std::string_view phase, std::uint64_t total) override {
    told += std::string(phase) + ' ' + std::to_string(total);
  }
  void advance(std::uint64_t steps) override { told += '+' + std::to_string(steps); }
  void finish() override { told += '.'; }
  std::string told;
};

std::string error_of(const std::function<std::string(Progress&)>& work, const Patience& p = {}) {
  Recorder recorder;
  try {
    guarded(work, recorder, p);
  } catch (const InputError& error) {
    return std::string("input: ") + error.what();
  } catch (const WorkError& error) {
    return std::string("work: ") + error.what();
  }
  return "none";
}

TEST(Guarded, GivesBackBytesAndProgress) {
  Recorder recorder;
  const std::string bytes = guarded(
      [](Progress& progress) {
        progress.start("render", 3);
        progress.advance(2);
        progress.finish();
        return std::string(1 << 20, 'x') + '\0' + "end";
      },
      recorder);
  EXPECT_EQ(bytes.size(), (1u << 20) + 4);
  EXPECT_TRUE(bytes.ends_with("end"));
  EXPECT_EQ(recorder.told, "render 3+2.");
}

TEST(Guarded, PassesErrorsOn) {
  EXPECT_EQ(error_of([](Progress&) -> std::string {
              throw InputError({"a.glsl", 3}, "wrong", "put it right");
            }),
            "input: a.glsl:3: wrong; put it right");
  EXPECT_EQ(error_of([](Progress&) -> std::string { throw WorkError("no driver", "get one"); }),
            "work: no driver; get one");
}

TEST(Guarded, StopsWorkThatSaysNothing) {
  EXPECT_THAT(error_of(
                  [](Progress& progress) -> std::string {
                    progress.start("render", 1);
                    for (;;) ::pause();
                  },
                  {30, 0.2}),
              ::testing::StartsWith("work: the OpenGL driver has drawn nothing for 0 s"));
}

TEST(Guarded, TellsIfTheWorkDies) {
  EXPECT_THAT(error_of([](Progress&) -> std::string { ::_exit(9); }),
              ::testing::StartsWith("work: the OpenGL driver broke off"));
}

TEST(Guarded, StopsWhenAskedTo) {
  cancel_requested = true;
  Recorder recorder;
  EXPECT_THROW(guarded(
                   [](Progress&) -> std::string {
                     for (;;) ::pause();
                   },
                   recorder),
               Cancelled);
  cancel_requested = false;
}

}  // namespace
}  // namespace penumbra::gl
