#include "bake_files.h"

#include <fmt/format.h>
#include <json/writer.h>

#include <filesystem>

#include "bake/preview.h"
#include "base/atomic_file.h"

namespace penumbra::app {
namespace {

std::string beside(const Arguments& a, const std::string& ending) {
  std::filesystem::path path(a.output);
  return path.replace_extension().string() + ending;
}

/// With the file names that the bake itself does not know.
std::string description_text(const Arguments& a, const bake::Baked& baked) {
  Json::Value out = baked.description;
  out["glb"] = std::filesystem::path(a.output).filename().string();
  for (Json::ArrayIndex i = 0; i < out["images"].size(); ++i)
    out["images"][i]["exr"] =
        std::filesystem::path(page_file(a, static_cast<int>(i), out["images"].size()))
            .filename()
            .string();
  Json::StreamWriterBuilder builder;
  builder["indentation"] = "  ";
  builder["emitUTF8"] = true;
  return Json::writeString(builder, out) + "\n";
}

}  // namespace

std::string page_file(const Arguments& a, int page, std::size_t pages) {
  return beside(a, pages > 1 ? fmt::format("-{}.exr", page + 1) : ".exr");
}

std::string description_file(const Arguments& a) { return beside(a, ".json"); }

void write_baked(const Arguments& a, const bake::Baked& baked) {
  const std::string glb = bake::glb_bytes(baked.model);
  write_file(a.output, glb);
  if (a.bake.lightmap) write_file(description_file(a), description_text(a, baked));
  if (!a.bake.preview.empty())
    write_file(a.bake.preview,
               bake::preview_html(std::filesystem::path(a.output).filename().string(), glb,
                                  bake::viewer_folder()));
}

}  // namespace penumbra::app
