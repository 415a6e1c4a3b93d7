// A glTF file, checked and ready to be converted.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf/json_document.h"
#include "scene/gltf/warnings.h"

namespace penumbra::gltf {

/// Holds what tinygltf understood of the JSON, and the bytes of the buffers. tinygltf sees only
/// JSON that check_document() has passed, without buffers and images: it opens no file and touches
/// no byte. Every index in `model` is in range; every bufferView lies within its buffer, every
/// accessor within its bufferViews.
class Document {
 public:
  /// Throws InputError.
  explicit Document(const std::string& path);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const JsonDocument& json() const { return json_; }
  const tinygltf::Model& model() const { return model_; }
  Warnings& warnings() { return warnings_; }

  /// The accessor with the indices of a primitive, −1 if there is none. Not in the model: tinygltf
  /// refuses sparse ones without a bufferView.
  int indices_of(std::size_t mesh, std::size_t primitive) const;

  /// The bytes of a bufferView.
  std::string_view bytes_of_view(int view) const;

  /// A file that `uri` names, read once; null if it is not a local, regular, readable file.
  std::shared_ptr<const std::string> external_file(const std::string& uri);

  /// The sizes of the file and of the external files read so far.
  std::uint64_t bytes_held() const { return held_; }

  /// To be called before `bytes` are allocated for what `path` asks for. Many small descriptions
  /// may refer to the same bytes, so that a short file could ask for any amount: throws InputError
  /// when the sum exceeds 256 MiB and 64 times what the files hold.
  void spend(std::uint64_t bytes, const std::string& path);

 private:
  void check_version() const;
  void load_buffers();
  std::shared_ptr<const std::string> load_buffer(Json::Value& buffer, const std::string& path);
  void check_views() const;
  void parse_model();

  JsonDocument json_;
  tinygltf::Model model_;
  Warnings warnings_;
  std::vector<std::shared_ptr<const std::string>> owned_;
  std::vector<std::string_view> buffers_;
  std::map<std::string, std::shared_ptr<const std::string>> files_;
  std::uint64_t held_ = 0, spent_ = 0;
};

}  // namespace penumbra::gltf
